#include "input/sections.h"
#include "model/mass.h"
#include "model/rpm.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace whirl::input {
namespace {

/// The keys that the table has; all of them become known.
std::vector<std::string> given(CheckedTable &table, const std::vector<std::string> &keys) {
    std::vector<std::string> found;
    for (const std::string &key : keys)
        if (table.has(key))
            found.push_back(key);
    return found;
}

model::Disc read_disc_of_geometry(CheckedTable &table, const Materials &materials, double z) {
    const double outer = table.number("outer", Quantity::length, Range::positive());
    const double inner = table.number_or("inner", 0, Quantity::length, Range::not_negative());
    const double width = table.number("width", Quantity::length, Range::positive());
    const double rho = material_of(table, materials).rho;
    if (inner >= outer) {
        table.fail("inner", fmt::format("expected an inner diameter below the outer one, {} m, "
                                        "got {} m",
                                        digits_apart(outer, inner), digits_apart(inner, outer)));
        return {};
    }
    return model::disc_from_geometry(z, outer, inner, width, rho);
}

model::Disc read_disc_of_inertias(CheckedTable &table) {
    model::Disc disc;
    disc.mass = table.number("mass", Quantity::mass, Range::not_negative());
    if (!table.has("Id") && !table.has("Ip"))
        return disc; // a point mass
    disc.Id = table.number("Id", Quantity::inertia, Range::not_negative());
    disc.Ip = table.number("Ip", Quantity::inertia, Range::not_negative());
    return disc;
}

} // namespace

void read_discs(CheckedTable &root, const Materials &materials, model::Rotor &rotor) {
    read_each(root, "disc", rotor.discs, [&](CheckedTable &table, model::Disc &disc) {
        const auto inertias = given(table, {"mass", "Id", "Ip"});
        const auto geometry = given(table, {"outer", "inner", "width", "material"});
        const std::string name = table.text("name").value_or("");
        const double z = table.number("z", Quantity::length);
        if (!inertias.empty() && !geometry.empty())
            table.fail(geometry.front(), "expected either mass, Id, Ip or outer, inner, width, "
                                         "material, got both");
        else if (!inertias.empty())
            disc = read_disc_of_inertias(table);
        else if (!geometry.empty())
            disc = read_disc_of_geometry(table, materials, z);
        else
            table.fail("mass", "missing, expected mass (with Id and Ip), or outer and width");
        disc.name = name;
        disc.z = z;
    });
}

void read_anisotropies(CheckedTable &root, model::Rotor &rotor) {
    read_each(root, "anisotropy", rotor.anisotropies,
              [](CheckedTable &table, model::Anisotropy &anisotropy) {
                  read_place(table, anisotropy);
                  anisotropy.dI = table.number("dI", Quantity::inertia);
                  anisotropy.angle = table.number_or("angle", 0, Quantity::angle);
              });
}

void read_planes(CheckedTable &root, model::Rotor &rotor) {
    read_each(root, "plane", rotor.planes, read_place<model::CorrectionPlane>);
}

namespace {

/// Grade of a text such as "G 2.5" or of a number, mm/s; empty with a mistake.
std::optional<double> read_grade(CheckedTable &table) {
    const CheckedEntry grade = *table.entry("grade");
    std::string_view text = trimmed(grade.node.text);
    if (text.starts_with('G') || text.starts_with('g'))
        text.remove_prefix(1);
    std::optional<double> value = parse_number(trimmed(text));
    if (grade.node.is_number()) {
        table.context().numeric.insert_or_assign(grade.path, Quantity::number);
        value = grade.node.number;
    }
    if (value && *value > 0 && std::isfinite(*value))
        return value;
    grade.fail("expected a balance quality grade such as \"G 2.5\", got " + shown(grade.node));
    return std::nullopt;
}

/// The imbalance that a rule allows or asks for at a speed, for the mass of the rotor:
///  - `grade`: ISO 21940-11:2016, e = G/speed, so m r = G m / speed;
///  - `api`: API 617, 4 W/N oz in for W lb and N rpm; in SI 4 / 16 in m / N = 0.00635 m/N kg m.
double read_rule(CheckedTable &table, const model::Case &scene) {
    const bool graded = table.has("grade");
    const double mass = table.number_or("mass", model::mass_of_shaft_and_discs(scene.rotor),
                                        Quantity::mass, Range::positive());
    const auto own = table.optional_number("speed", Quantity::speed, Range::positive());
    const double share = table.number_or("share", 1, Quantity::number, Range::positive());
    const double fastest =
        scene.speeds ? std::max(std::abs(scene.speeds->from), std::abs(scene.speeds->to)) : 0;
    const double speed = own.value_or(scene.operation ? scene.operation->to : fastest);
    if (std::isnan(speed) || (!own && table.has("speed")))
        return 0; // said where it is wrong
    if (!(speed > 0)) {
        table.fail("speed", "missing, expected the angular speed in rad/s at which the rule holds, "
                            "or [operation] or [speeds]");
        return 0;
    }
    constexpr double millimetre = 1e-3; // m
    const auto grade = graded ? read_grade(table) : std::nullopt;
    const double mr = share * (graded ? grade.value_or(0) * millimetre * mass / speed
                                      : 0.00635 * mass / (speed * model::rpm));
    namespace as = model::as;
    table.context().remarks.emplace_back("{}: {}, {} of {} at {}", table.path(), as::imbalance(mr),
                                         graded ? fmt::format("G {:.3g}", grade.value_or(0))
                                                : "4W/N",
                                         as::mass(mass), as::speed(speed));
    return mr;
}

double read_mr(CheckedTable &table, const model::Case &scene) {
    const auto ways = given(table, {"mr", "grade", "api"});
    if (ways.size() > 1) {
        table.fail(ways[1], "expected one of mr, grade and api, got more");
        return 0;
    }
    if (table.has("grade") || table.flag_or("api", false))
        return read_rule(table, scene);
    return table.number("mr", Quantity::imbalance);
}

} // namespace

void read_imbalances(CheckedTable &root, model::Case &scene) {
    read_each(root, "imbalance", scene.rotor.imbalances,
              [&](CheckedTable &table, model::Imbalance &imbalance) {
                  read_place(table, imbalance);
                  imbalance.mr = read_mr(table, scene);
                  imbalance.phase = table.number_or("phase", 0, Quantity::angle);
              });
}

void read_forces(CheckedTable &root, model::Rotor &rotor) {
    read_each(root, "force", rotor.forces, [](CheckedTable &table, model::HarmonicForce &force) {
        read_place(table, force);
        force.amplitude = table.number("amplitude", Quantity::force, Range::not_negative());
        force.phase = table.number_or("phase", 0, Quantity::angle);
        force.multiple = table.optional_number("multiple", Quantity::number, Range::positive());
        force.frequency = table.optional_number("frequency", Quantity::speed, Range::positive());
        if (table.has("multiple") && table.has("frequency"))
            table.fail("frequency", "expected either multiple (of the spin speed) or frequency, "
                                    "got both");
        if (!table.has("multiple") && !table.has("frequency"))
            table.fail("multiple", "missing, expected the multiple of the spin speed at which the "
                                   "force acts, or its frequency in rad/s");
        // What is a multiple of the spin comes from the rotor, and turns with it.
        force.direction = static_cast<model::ForceDirection>(table.choice(
            "direction", {"x", "y", "forward", "backward"}, table.has("multiple") ? 2 : 0));
    });
}

void read_probes(CheckedTable &root, model::Rotor &rotor) {
    read_each(root, "probe", rotor.probes, [&rotor](CheckedTable &table, model::Probe &probe) {
        probe.name = table.text("name").value_or("");
        probe.on_pedestal = table.choice("on", {"shaft", "pedestal"}, 0) == 1;
        if (const auto bearing = table.entry("bearing"))
            probe.bearing = support_of(*bearing, rotor);
        const bool there = probe.on_pedestal && probe.bearing; // it needs no place of its own
        if (there && table.has("z"))
            table.fail("z", "expected either z or the bearing on whose pedestal it sits, got both");
        probe.z = there ? rotor.bearings[*probe.bearing].z : table.number("z", Quantity::length);
        probe.angle = table.number_or("angle", 0, Quantity::angle);
        if (table.has("relative"))
            probe.relative = table.flag_or("relative", false);
        if (probe.on_pedestal && probe.relative)
            table.fail("relative", "expected only of a probe that reads the shaft, got one on a "
                                   "pedestal");
        if (probe.on_pedestal && std::isfinite(probe.z) && !rotor.pedestal_of(probe))
            table.fail("on", "expected a bearing with a pedestal, got one with none");
    });
}

} // namespace whirl::input
