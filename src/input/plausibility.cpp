#include "input/validate.h"
#include "model/mass.h"
#include "model/rpm.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

namespace whirl::input {

namespace {

namespace as = model::as;

/// What no machine has more or less of.
struct Usual {
    double least, most;
    model::ValueOf of;
    const char *example; ///< of the case file, with its unit
};
constexpr Usual of_modulus{5e8, 1.3e12, as::pressure, "steel has 2.1e11 Pa, \"210 GPa\""};
constexpr double made_rigid = 5e13; // Pa: no slip by a power of ten or two
constexpr Usual of_density{200, 25000, as::density, "steel has 7850 kg/m3, \"7.85 g/cm3\""};
constexpr double massless = 1e-3; // kg/m3: a shaft made so
constexpr Usual of_length{1e-3, 60, as::length,
                          "lengths are in m unless they have a unit: \"1200 mm\""};
constexpr Usual of_clearance{1e-6, 0.02, as::length, "it is in m unless it has a unit: \"0.1 mm\""};
constexpr Usual of_diameter{1e-4, 10, as::length,
                            "diameters are in m unless they have a unit: \"50 mm\""};

constexpr Usual of_rolling{0, 1e-3, as::length, "it is in m unless it has a unit: \"10 um\""};

/// Collects remarks, each once.
class Remarks {
  public:
    explicit Remarks(model::Case &scene) : _scene(scene) {}

    template <class... Parts> void add(const Parts &...parts) {
        auto &all = _scene.remarks;
        if (const model::Sentence remark(parts...); std::ranges::find(all, remark) == all.end())
            all.push_back(remark);
    }
    void check(const std::string &what, double value, const Usual &usual) {
        if (value < usual.least || value > usual.most)
            add("{} of {} is unlike any machine's; {}", what, usual.of(value), usual.example);
    }

  private:
    model::Case &_scene;
};

void check_density(double rho, Remarks &remarks) {
    constexpr double lightest = 1.5e-9; // of metals in t/mm3
    constexpr double heaviest = 9.5e-9;
    if (rho > massless)
        remarks.check("a density", rho, of_density);
    else if (rho > lightest && rho < heaviest)
        remarks.add("a density of {} makes the shaft massless; with a unit, \"{} t/mm3\", it is "
                    "that of a metal",
                    as::density(rho), as::number(rho));
}

void check_shaft(const model::Shaft &shaft, Remarks &remarks) {
    remarks.check("a shaft length", shaft.length(), of_length);
    for (const model::Segment &segment : shaft.segments) {
        if (segment.material.E < made_rigid)
            remarks.check("a modulus E", segment.material.E, of_modulus);
        check_density(segment.material.rho, remarks);
        remarks.check("a shaft diameter", std::max(segment.outer_start, segment.outer_end),
                      of_diameter);
    }
}

void check_clearances(const model::Rotor &rotor, Remarks &remarks) {
    for (const model::Bearing &bearing : rotor.bearings)
        if (bearing.clearance)
            remarks.check("a radial clearance", *bearing.clearance, of_clearance);
}

void check_rolling(const model::Rotor &rotor, Remarks &remarks) {
    for (const model::Balancer &balancer : rotor.balancers)
        if (const auto *balls = std::get_if<model::Balls>(&balancer.parts))
            for (const model::BallRow &row : balls->rows)
                remarks.check("a lever arm of the resistance to rolling", row.rolling, of_rolling);
}

/// Of the thickest segment and of discs, as wide as their inertia says, m.
double largest_radius(const model::Rotor &rotor) {
    double radius = 0;
    for (const model::Segment &segment : rotor.shaft.segments)
        radius = std::max({radius, segment.outer_start / 2, segment.outer_end / 2});
    for (const model::Disc &disc : rotor.discs)
        if (disc.mass > 0)
            radius = std::max(radius, std::sqrt(2 * disc.Ip / disc.mass));
    return radius;
}

/// Whether a speed is given with a unit, and another one than rad/s.
bool in_other_unit(const Node *speed) {
    if (speed == nullptr || speed->kind != Node::Kind::text)
        return false;
    const std::size_t unit = speed->text.find_first_not_of("0123456789.eE+-_ ");
    return unit != std::string::npos && !speed->text.substr(unit).starts_with("rad");
}

/// The speeds of the case are in another unit than rad/s: a number alone beside them has a remark
/// of its own.
bool in_other_units(const Node &tree) {
    return in_other_unit(find_path(tree, "speeds.from")) ||
           in_other_unit(find_path(tree, "speeds.to"));
}

void check_speeds(const model::Case &scene, const Node &tree, Remarks &remarks) {
    constexpr double fastest = 500; // m/s: where discs of steel burst
    std::vector<std::pair<const char *, double>> speeds;
    if (scene.speeds)
        speeds = {{"speeds.from", scene.speeds->from}, {"speeds.to", scene.speeds->to}};
    if (const auto &operation = scene.operation) {
        speeds.insert(speeds.end(),
                      {{"operation.from", operation->from}, {"operation.to", operation->to}});
        if (operation->trip)
            speeds.emplace_back("operation.trip", *operation->trip);
    }
    if (scene.modes.speed && !in_other_units(tree))
        speeds.emplace_back("modes.speed", *scene.modes.speed);
    for (const auto &[key, speed] : speeds) {
        const Node *node = find_path(tree, key);
        const double surface = largest_radius(scene.rotor) * std::abs(speed);
        if (node && node->is_number() && surface > fastest)
            remarks.add("{} = {} is in rad/s, {} rpm: the rotor's surface moves at {} m/s; with a "
                        "unit, \"{} rpm\", it is that speed",
                        key, as::number(speed), as::number(speed * model::rpm),
                        as::number(surface, 3), as::number(speed));
    }
}

/// A number alone beside speeds in another unit.
void check_mode_speed(const Node &tree, Remarks &remarks) {
    const Node *node = find_path(tree, "modes.speed");
    if (node && node->is_number() && node->number != 0 && in_other_units(tree))
        remarks.add(
            "modes.speed = {} is in rad/s, {} rpm, where [speeds] have another unit; with a "
            "unit, \"{} rpm\", it is that speed",
            as::number(node->number), as::number(node->number * model::rpm),
            as::number(node->number));
}

/// Beyond a turn, without a unit.
void check_angle(const Node &tree, const std::string &path, Remarks &remarks) {
    const Node *node = find_path(tree, path);
    if (node && node->is_number() && std::abs(node->number) > 2 * std::numbers::pi + 1e-9)
        remarks.add("{} = {} is in rad, more than a turn; with a unit, \"{} deg\", it is that "
                    "angle",
                    path, as::number(node->number), as::number(node->number));
}

void check_angles(const model::Rotor &rotor, const Node &tree, Remarks &remarks) {
    const auto all = [&](const char *list, std::size_t count, const char *key) {
        for (std::size_t i = 0; i < count; ++i)
            check_angle(tree, fmt::format("{}[{}].{}", list, i, key), remarks);
    };
    all("imbalance", rotor.imbalances.size(), "phase");
    all("anisotropy", rotor.anisotropies.size(), "angle");
    all("balancer", rotor.balancers.size(), "imbalance_phase");
    all("force", rotor.forces.size(), "phase");
    all("probe", rotor.probes.size(), "angle");
    for (std::size_t i = 0; i < rotor.balancers.size(); ++i)
        for (const std::string &list :
             {fmt::format("balancer[{}].position", i), fmt::format("simulate.ball_angles[{}]", i)})
            for (int part = 0; find_path(tree, fmt::format("{}[{}]", list, part)); ++part)
                check_angle(tree, fmt::format("{}[{}]", list, part), remarks);
}

void check_tables(const model::Case &scene, Remarks &remarks) {
    if (!scene.speeds)
        return;
    const double low = std::min(scene.speeds->from, scene.speeds->to);
    const double high = std::max(scene.speeds->from, scene.speeds->to);
    const std::size_t others = scene.rotor.supports().size();
    const auto &bearings = scene.rotor.bearings;
    const auto reach = [&](std::size_t i) {
        return std::pair(bearings[i].speeds.front(), bearings[i].speeds.back());
    };
    const auto too_short = [&](std::size_t i) {
        return bearings[i].depends_on_speed() && (low < reach(i).first || high > reach(i).second);
    };
    for (std::size_t i = 0; i < bearings.size(); ++i) {
        if (!too_short(i))
            continue;
        std::string tables; // all of the same reach, said at the first
        bool first = true;
        for (std::size_t k = 0; k < bearings.size(); ++k) {
            if (!too_short(k) || reach(k) != reach(i))
                continue;
            first = first && k >= i;
            tables += fmt::format("{}{}[{}]", tables.empty() ? "" : ", ",
                                  bearings[k].seal ? "seal" : "bearing",
                                  bearings[k].seal ? k - others : k);
        }
        if (first)
            remarks.add("[speeds] reach from {}, the table of {} from {}: outside of it the "
                        "coefficients are those at its end",
                        as::speed.range(low, high), tables,
                        as::speed.range(reach(i).first, reach(i).second));
    }
}

/// Imbalances that are all nothing; one that puts the centre of mass outside of the rotor: one in g
/// mm without its unit.
void check_imbalances(const model::Rotor &rotor, Remarks &remarks) {
    const auto &all = rotor.imbalances;
    if (!all.empty() && std::ranges::all_of(all, [](const auto &one) { return one.mr == 0; }))
        remarks.add("every imbalance is 0: nothing excites the rotor, its response is 0");
    const double mass = model::mass_of_shaft_and_discs(rotor);
    for (std::size_t i = 0; mass > 0 && i < rotor.imbalances.size(); ++i) {
        const double mr = std::abs(rotor.imbalances[i].mr);
        if (mr > mass * largest_radius(rotor))
            remarks.add(
                "an imbalance of {} moves the centre of mass of a rotor of {} by {}, out of "
                "the rotor; it is in kg m unless it has a unit: \"50 g mm\"",
                as::imbalance(mr), as::mass(mass), as::length(mr / mass, 4));
    }
}

/// Discs whose mass stands, in the mean, farther from their centre than the shaft is long: a moment
/// of inertia a power of ten too large.
void check_inertias(const model::Rotor &rotor, Remarks &remarks) {
    for (std::size_t i = 0; i < rotor.discs.size(); ++i) {
        const model::Disc &disc = rotor.discs[i];
        const double inertia = std::max(disc.Id, disc.Ip);
        const double gyration = std::sqrt(inertia / disc.mass);
        if (disc.mass > 0 && gyration > rotor.shaft.length())
            remarks.add("disc[{}]: {} of {} is a radius of gyration of {}, more than the shaft is "
                        "long ({}); moments of inertia are in kg m2 unless they have a unit: "
                        "\"70 kg cm2\"",
                        i, as::inertia(inertia), as::mass(disc.mass), as::length(gyration, 4),
                        as::length(rotor.shaft.length(), 4));
    }
}

/// Bearings in which the rotor would sink by more than its length while it turns far faster than it
/// swings in them: stiffnesses in N/um or N/mm without their unit. (Slow ones are numbers without
/// dimension, of a paper.)
void check_stiffness(const model::Case &scene, Remarks &remarks) {
    constexpr double gravity = 9.80665;
    constexpr double far_faster = 30;
    const model::Rotor &rotor = scene.rotor;
    if (!scene.speeds)
        return;
    const double top = std::max(std::abs(scene.speeds->from), std::abs(scene.speeds->to));
    double stiffness = 0;
    for (const model::Bearing &bearing : rotor.bearings) {
        if (bearing.depends_on_speed())
            return;
        stiffness += std::max(bearing.rows.front().k(0, 0), bearing.rows.front().k(1, 1));
    }
    const double mass = model::mass_of_shaft_and_discs(rotor);
    const double sag = mass * gravity / stiffness;
    if (stiffness > 0 && sag > rotor.shaft.length() &&
        top > far_faster * std::sqrt(stiffness / mass))
        remarks.add("bearings of {} together let a rotor of {} sink by {}, more than its length; "
                    "stiffnesses are in N/m unless they have a unit: \"100 N/um\"",
                    as::stiffness(stiffness), as::mass(mass), as::length(sag, 4));
}

template <class Items> void check_names(const char *what, const Items &items, Remarks &remarks) {
    std::set<std::string> seen;
    for (const auto &item : items)
        if (!item.name.empty() && !seen.insert(item.name).second)
            remarks.add("{} \"{}\" stands more than once: results name them alike", what,
                        item.name);
}

} // namespace

void add_remarks(model::Case &scene, const Node &tree) {
    if (!model::has_shaft(scene))
        return; // readings alone
    Remarks remarks(scene);
    const model::Rotor &rotor = scene.rotor;
    const std::size_t before = scene.remarks.size();
    check_shaft(rotor.shaft, remarks);
    if (scene.remarks.size() == before) { // a mass that can be relied on
        check_imbalances(rotor, remarks);
        check_inertias(rotor, remarks);
        check_stiffness(scene, remarks);
    }
    check_clearances(rotor, remarks);
    check_rolling(rotor, remarks);
    check_speeds(scene, tree, remarks);
    check_mode_speed(tree, remarks);
    check_angles(rotor, tree, remarks);
    check_tables(scene, remarks);
    check_names("disc", rotor.discs, remarks);
    check_names("bearing", rotor.supports(), remarks);
    check_names("seal", rotor.seals(), remarks);
    check_names("balancer", rotor.balancers, remarks);
    check_names("plane", rotor.planes, remarks);
    if (rotor.supports().empty())
        remarks.add("the rotor has no bearings: it floats freely");
}

} // namespace whirl::input
