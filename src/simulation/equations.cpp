#include "simulation/equations.h"

#include "assembly/planar_part.h"
#include "balancers/balanced_position.h"
#include "balancers/kind.h"
#include "forced/forced_motion.h"
#include "forced/response_places.h"
#include "linalg/check.h"
#include "mesh_error/estimate.h"
#include "model/errors.h"
#include "modes/orbits.h"
#include "results/formulation.h"
#include "simulation/scene_outside.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <variant>

namespace whirl::simulation {

namespace {

using results::Sentence;
namespace as = results::as;

/// Of the first ball of a balancer at a start that the case does not give, rad: a start in which
/// all are spread evenly would be one of balance between them, which need not be stable.
constexpr double out_of_place = 0.01;

using std::numbers::pi;
constexpr double most_revolutions = 1e7; ///< an angle of 6e7 rad is still known to 1e-8 rad

/// Inertia against tilting of the point mass that is the imbalance, kg m2; 0 for an eccentricity.
double tilt_inertia_of_imbalance(const model::Balancer &b) {
    return b.tilt_inertia ? balancers::imbalance_inertia(b) : 0;
}

/// The rotor with the constant inertia of all that is attached: parts that turn with the rotor as
/// whole discs, others and point masses as discs without polar inertia (their gyroscopic effect is
/// in their own equations). Anisotropies stay for the nodes where they are; they are masses of
/// their own.
model::Rotor rotor_with_masses(const model::Rotor &rotor) {
    model::Rotor with = rotor;
    with.balancers.clear();
    for (const model::Balancer &b : rotor.balancers) {
        const balancers::PartsInertia parts = balancers::kind_of(b)->inertia();
        model::Disc disc;
        disc.name = b.name;
        disc.z = b.z;
        disc.mass = parts.mass;
        if (b.tilt_inertia) {
            disc.Id = (parts.on_circle + parts.own) / 2;
            disc.Ip = parts.turn_with_rotor ? parts.on_circle + parts.own : 0;
        }
        disc.mass += balancers::imbalance_mass(b);
        disc.Id += tilt_inertia_of_imbalance(b) / 2;
        with.discs.push_back(disc);
    }
    return with;
}

/// Of the rotor and its discs, without what has an equation of its own.
double polar_inertia(const assembly::Discretization &d, const model::Case &scene) {
    double inertia = assembly::polar_inertia(d);
    for (const model::Balancer &b : scene.rotor.balancers)
        if (const auto parts = balancers::kind_of(b)->inertia();
            parts.turn_with_rotor && b.tilt_inertia)
            inertia -= parts.on_circle + parts.own;
    return inertia;
}

std::string where(const model::Case &scene) { return scene.file.string(); }

void refuse_what_is_missing(const model::Case &scene) {
    if (scene.simulate.time <= 0)
        throw model::BadInput(fmt::format("{}: simulate: missing, expected a section [simulate] "
                                          "with the time to simulate, as time = 20",
                                          where(scene)));
    if (!has_drive(scene))
        throw model::BadInput(
            fmt::format("{}: imbalance: missing, expected something that moves the rotor: an "
                        "[[imbalance]], as z = 0.5, mr = \"100 g mm\", a [[balancer]], "
                        "[[simulate.imbalance]], [[simulate.force]] or [simulate.base]",
                        where(scene)));
    if (scene.rotor.shaft.asymmetric())
        throw model::AnalysisFailure("motion in time needs a shaft of equal bending stiffnesses; "
                                     "this one has a segment with asymmetry");
    const bool turning_masses = !scene.rotor.balancers.empty() || !scene.rotor.anisotropies.empty();
    if (turning_masses && !scene.rotor.support_masses_isotropic())
        throw model::AnalysisFailure(
            "motion in time with balancers or anisotropies needs mass coefficients of bearings and "
            "masses of pedestals that are the same in x and y and do not couple them");
    if (scene.simulate.torque)
        return;
    if (!scene.simulate.run_up.empty())
        return;
    if (!scene.speeds)
        throw model::BadInput(fmt::format("{}: speeds: expected a spin speed: [speeds] with from "
                                          "and count = 1, simulate.run_up or simulate.torque, "
                                          "got none",
                                          where(scene)));
    if (scene.speeds->count != 1)
        throw model::BadInput(
            fmt::format("{}: speeds.count: expected 1, the one spin speed of the "
                        "motion, got {}; try --set speeds.count=1 --set speeds.from=...",
                        where(scene), scene.speeds->count));
}

/// Masses on circles spread evenly, the first out of the symmetry that would hide unstable motions;
/// parts without circles at rest but for that.
std::vector<double> usual_start(const balancers::Kind &kind) {
    std::vector<double> angles(kind.start_angles(), 0.0);
    const auto n = static_cast<double>(kind.circled().size());
    for (std::size_t i = 0; i < kind.circled().size(); ++i)
        angles[i] = pi / n * (1 + 2 * static_cast<double>(i));
    angles.front() += out_of_place;
    return angles;
}

/// Index of the plane at z, made where there is none yet.
int plane_at(double z, const assembly::Discretization &d, std::vector<double> &places,
             MovingParts &parts) {
    const auto same = std::ranges::find(places, z);
    const auto index = static_cast<int>(same - places.begin());
    if (same == places.end()) {
        places.push_back(z);
        parts.planes.push_back(
            {parts.rotor.row(d.deflection_at(z)), parts.rotor.row(d.slope_at(z))});
    }
    return index;
}

/// Inertia +dI against tilting along the axis of smaller inertia, -dI across it: what surplus
/// masses on that axis, less those that would make it even, add.
void add_anisotropy(const model::Anisotropy &anisotropy, int plane, MovingParts &parts) {
    FixedMass mass;
    mass.plane = plane;
    mass.mass.tilt = anisotropy.dI;
    mass.phase = anisotropy.angle;
    parts.fixed.push_back(mass);
    mass.mass.tilt = -anisotropy.dI;
    mass.phase += pi / 2;
    parts.fixed.push_back(mass);
}

/// Until when the parts of a balancer are held, s.
double released(const model::Case &scene, std::size_t index, MotionScene &motion) {
    const model::Balancer &b = scene.rotor.balancers[index];
    const auto *balls = std::get_if<model::Balls>(&b.parts);
    if (!balls || !balls->release_speed)
        return 0;
    const std::optional<double> at = motion.parts.spin.reaches(*balls->release_speed);
    if (!at || *at >= scene.simulate.time)
        throw model::BadInput(Sentence(
            "{}: {}.release_speed: expected a speed that the rotor reaches while it is "
            "simulated, got {}; held = true holds the balls at every speed",
            where(scene), scene.rotor.balancer_path(index), as::speed(*balls->release_speed)));
    if (*at > 0)
        motion.notes.emplace_back("the balls of {} are held until {}, when the rotor reaches {}",
                                  model::name_or_number(b.name, "balancer", index), as::time(*at),
                                  as::speed(*balls->release_speed));
    return *at;
}

void add_masses(const model::Case &scene, std::size_t index, int plane, MotionScene &motion) {
    const model::Balancer &b = scene.rotor.balancers[index];
    const double g = scene.simulate.gravity;
    const auto kind = balancers::kind_of(b);
    motion.parts.free.push_back(
        {plane, kind->motion(b.tilt_inertia, g), released(scene, index, motion)});
    motion.moment += kind->reach().imbalance;
    if (const std::complex<double> centre = kind->race_centre(); centre != 0.0) {
        // All parts at the centre of their circles, which turns with the rotor.
        const double mass = kind->inertia().mass;
        const double e = std::abs(centre);
        FixedMass parts;
        parts.plane = plane;
        parts.mass = {mass * e, mass * e * e, 0, mass * e * g};
        parts.phase = std::arg(centre);
        motion.parts.fixed.push_back(parts);
    }
    if (b.imbalance > 0) {
        FixedMass mass;
        mass.plane = plane;
        const double inertia = tilt_inertia_of_imbalance(b);
        mass.mass = {b.imbalance, inertia, inertia, b.imbalance * g};
        mass.phase = b.imbalance_phase;
        motion.parts.fixed.push_back(mass);
    }
}

void add_all_masses(const model::Case &scene, const assembly::Discretization &d,
                    MotionScene &motion) {
    std::vector<double> places;
    for (std::size_t i = 0; i < scene.rotor.balancers.size(); ++i)
        add_masses(scene, i, plane_at(scene.rotor.balancers[i].z, d, places, motion.parts), motion);
    for (const model::Anisotropy &anisotropy : scene.rotor.anisotropies)
        add_anisotropy(anisotropy, plane_at(anisotropy.z, d, places, motion.parts), motion.parts);
    for (const model::Imbalance &imbalance : scene.rotor.imbalances)
        motion.parts.fixed.push_back(fixed_mass(imbalance, scene, d, motion.parts));
    motion.start_angles = start_of(scene.rotor, scene.simulate.ball_angles);
    add_outside(scene, d, motion);
}

/// The drive; fills fastest.
/// @returns the highest |speed| of the spin, or fastest of a rotor that does not turn, rad/s
double set_drive(const model::Case &scene, const assembly::Discretization &d, MotionScene &motion) {
    const model::SimulateSettings &s = scene.simulate;
    if (s.torque) {
        motion.parts.motor = Motor{*s.torque, s.torque_slope};
        const double start = scene.speeds ? scene.speeds->from : 0;
        motion.parts.spin = Spin(start);
        double inertia = motion.parts.polar_inertia;
        for (const model::Balancer &b : scene.rotor.balancers) {
            const balancers::PartsInertia parts = balancers::kind_of(b)->inertia();
            inertia += parts.on_circle + parts.own;
        }
        const double free_run = start + *s.torque / inertia * s.time;
        const double limit = s.torque_slope > 0 ? *s.torque / s.torque_slope : free_run;
        const double last = std::abs(free_run) < std::abs(limit) ? free_run : limit;
        motion.fastest = std::max(std::abs(start), std::abs(last));
    } else {
        motion.parts.spin = s.run_up.empty() ? Spin(scene.speeds->from) : Spin(s.run_up);
        motion.fastest = motion.parts.spin.fastest(s.time);
    }
    const double speed = motion.fastest;
    const bool shaken = !scene.simulate.forces.empty() || scene.simulate.base;
    if (scene.rotor.balancers.empty() && shaken)
        motion.fastest = std::max(motion.fastest, scale_at_rest(scene, d));
    if (!(motion.fastest > 0))
        throw model::BadInput(fmt::format("{}: speeds.from: expected a spin speed other than 0, "
                                          "got a rotor at rest",
                                          where(scene)));
    const double turns = motion.fastest * s.time / (2 * pi);
    if (turns > most_revolutions)
        throw model::BadInput(fmt::format("{}: simulate.time: expected a time in s of at most "
                                          "{:.0e} revolutions, got {} s, {:.3g} revolutions",
                                          where(scene), most_revolutions, s.time, turns));
    return speed > 0 ? speed : motion.fastest;
}

void add_notes(const model::Case &scene, MotionScene &motion) {
    for (const model::Balancer &b : scene.rotor.balancers) {
        const Sentence name = b.name.empty() ? Sentence("the balancer at z = {}", as::length(b.z))
                                             : Sentence("{}", b.name);
        const auto kind = balancers::kind_of(b);
        if (!kind->circled().empty() && balancers::capacity(b) < 1)
            motion.notes.emplace_back(model::Weight::warning,
                                      "{} cannot balance its imbalance: capacity E = {} is below 1",
                                      name, as::number(balancers::capacity(b), 4));
        if (!kind->damped())
            motion.notes.emplace_back("{} has no damping: its {} cannot come to rest in the rotor",
                                      name, kind->parts());
    }
    if (!scene.rotor.damped())
        motion.notes.emplace_back("no damping in the bearings: whirl does not die out");
    if (scene.simulate.ball_angles.empty() && !scene.rotor.balancers.empty())
        motion.notes.emplace_back(
            "simulate.ball_angles is not given: the {}, the first of each "
            "balancer offset by {}; other starts may end otherwise",
            std::ranges::any_of(
                scene.rotor.balancers,
                [](const model::Balancer &b) { return !balancers::kind_of(b)->circled().empty(); })
                ? "balls start spread evenly"
                : "pendulums start at rest in the rotor",
            as::angle(out_of_place));
    if (std::ranges::any_of(scene.rotor.balancers,
                            [](const model::Balancer &b) { return !b.tilt_inertia; }))
        motion.notes.emplace_back(model::Weight::information,
                                  "the tilting inertia of the balls is neglected");
}

int element_order(const model::Case &scene) {
    model::Case bare = scene;
    bare.rotor.balancers.clear();
    bare.rotor.anisotropies.clear();
    return mesh_error::resolve_order_in_best_form(bare);
}

} // namespace

bool has_imbalance(const model::Rotor &rotor) {
    return std::ranges::any_of(rotor.balancers,
                               [](const model::Balancer &b) { return b.imbalance > 0; }) ||
           std::ranges::any_of(rotor.imbalances,
                               [](const model::Imbalance &i) { return i.mr != 0; });
}

std::vector<double> start_of(const model::Rotor &rotor,
                             const std::vector<std::vector<double>> &given) {
    std::vector<double> all;
    for (std::size_t i = 0; i < rotor.balancers.size(); ++i) {
        const auto kind = balancers::kind_of(rotor.balancers[i]);
        std::vector<double> start = given.empty() ? usual_start(*kind) : given[i];
        start.resize(kind->coordinates().size()); // all others at rest at 0
        all.insert(all.end(), start.begin(), start.end());
    }
    return all;
}

model::Rotor rotor_without_balls(const model::Rotor &rotor) {
    model::Rotor bare = rotor;
    bare.balancers.clear();
    const bool own = has_imbalance(rotor);
    for (const model::Balancer &b : rotor.balancers) {
        const double capacity = balancers::kind_of(b)->reach().side_by_side;
        bare.imbalances.push_back({b.name, b.z, own ? b.imbalance : capacity, b.imbalance_phase});
        model::Disc disc; // keeps a node at the balancer
        disc.name = b.name;
        disc.z = b.z;
        disc.mass = balancers::imbalance_mass(b);
        disc.Id = tilt_inertia_of_imbalance(b) / 2;
        disc.Ip = tilt_inertia_of_imbalance(b);
        if (disc.Id > 0 && rotor.bearings_isotropic())
            bare.anisotropies.push_back({b.name, b.z, disc.Id, b.imbalance_phase});
        bare.discs.push_back(disc);
    }
    return bare;
}

MotionScene motion_scene(const model::Case &scene) {
    refuse_what_is_missing(scene);
    MotionScene motion;
    motion.order = element_order(scene);
    const assembly::Discretization d(rotor_with_masses(rotor_with_nodes(scene)), motion.order);
    motion.elements = static_cast<int>(d.shaft_mesh().spans.size());
    motion.parts.polar_inertia = scene.simulate.inertia + polar_inertia(d, scene);
    const double speed = set_drive(scene, d, motion);
    reduction::ReductionGoal goal;
    goal.speed = speed;
    goal.varies = motion.parts.motor || !motion.parts.spin.constant() ||
                  !(motion.parts.spin.fastest(scene.simulate.time) > 0);
    goal.fastest = std::max(motion.fastest, fastest_outside(scene, speed));
    goal.outside = loads_outside(scene);
    goal.tolerance = scene.simulate.reduction_tolerance;
    goal.modes = scene.reduction ? scene.simulate.modes : d.planar_size();
    goal.places = places_of(scene);
    goal.watched = watched_places_of(scene);
    for (const model::Anisotropy &anisotropy : scene.rotor.anisotropies)
        goal.tilted.push_back(anisotropy.z);
    motion.parts.rotor = reduction::reduce(d, goal);
    add_all_masses(scene, d, motion);
    add_notes(scene, motion);
    return motion;
}

} // namespace whirl::simulation
