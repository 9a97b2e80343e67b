#include "simulation/scene_outside.h"

#include "assembly/assemble.h"
#include "assembly/planar_part.h"
#include "forced/response_places.h"

#include <algorithm>
#include <cmath>

namespace whirl::simulation {

namespace {

/// Imbalance that would move the rotor as much as the forces and the foundation do, kg m.
double moment_of_forces(const model::SimulateSettings &s, double mass, double speed) {
    double force = 0;
    for (const model::StationForce &f : s.forces)
        force += std::hypot(f.x, f.y);
    if (s.base && s.base->harmonic)
        force += mass * std::hypot(s.base->harmonic->x, s.base->harmonic->y);
    double largest = 0;
    if (s.base)
        for (const model::BaseMotion::Row &row : s.base->table)
            largest = std::max(largest, std::hypot(row.x, row.y));
    return (force + mass * largest) / (speed * speed);
}

std::vector<double> each_once(std::vector<double> values) {
    std::ranges::sort(values);
    values.erase(std::unique(values.begin(), values.end()), values.end());
    return values;
}

/// Stations at which a rotor is looked at, whatever acts there.
std::vector<double> attached_places_of(const model::Rotor &rotor) {
    std::vector<double> places;
    const auto add = [&places](const auto &all) {
        for (const auto &one : all)
            places.push_back(one.z);
    };
    add(rotor.discs);
    add(rotor.bearings);
    add(rotor.probes);
    return each_once(std::move(places));
}

} // namespace

bool has_drive(const model::Case &scene) {
    const model::SimulateSettings &s = scene.simulate;
    return !scene.rotor.balancers.empty() || has_imbalance(scene.rotor) || !s.imbalances.empty() ||
           !s.forces.empty() || s.base;
}

model::Rotor rotor_with_nodes(const model::Case &scene) {
    model::Rotor rotor = scene.rotor;
    for (const model::SuddenImbalance &imbalance : scene.simulate.imbalances)
        rotor.imbalances.push_back({imbalance.name, imbalance.z, 0, 0});
    for (const model::StationForce &force : scene.simulate.forces)
        rotor.imbalances.push_back({force.name, force.z, 0, 0});
    return rotor;
}

std::vector<reduction::ReductionGoal::Outside> loads_outside(const model::Case &scene) {
    std::vector<reduction::ReductionGoal::Outside> loads;
    for (const model::StationForce &force : scene.simulate.forces)
        loads.push_back({std::abs(force.frequency), force.z});
    if (const auto &base = scene.simulate.base; base && base->harmonic)
        loads.push_back({std::abs(base->harmonic->frequency), std::nullopt});
    return loads;
}

double fastest_outside(const model::Case &scene, double speed) {
    double fastest = 0;
    for (const reduction::ReductionGoal::Outside &load : loads_outside(scene))
        fastest = std::max(fastest, load.frequency);
    if (scene.simulate.gravity != 0 &&
        (!scene.rotor.balancers.empty() || !scene.rotor.anisotropies.empty()))
        fastest = std::max(fastest, 2 * speed);
    return fastest;
}

double scale_at_rest(const model::Case &scene, const assembly::Discretization &d) {
    const assembly::PlanarPair pair = assembly::planar_pair(d, 0);
    const Eigen::VectorXd v = d.rigid_motion(false);
    const double bounce = std::max(0.0, v.dot(pair.K * v)) / v.dot(pair.M * v);
    return std::max(fastest_outside(scene, 0), std::sqrt(bounce));
}

std::vector<double> places_of(const model::Case &scene) {
    const model::Rotor &rotor = scene.rotor;
    std::vector<double> places;
    const auto add = [&places](const auto &all) {
        for (const auto &one : all)
            places.push_back(one.z);
    };
    add(rotor.balancers);
    add(rotor.imbalances);
    add(scene.simulate.imbalances);
    add(scene.simulate.forces);
    if (rotor.balancers.empty())
        for (const double z : attached_places_of(rotor))
            places.push_back(z);
    return each_once(std::move(places));
}

std::vector<double> watched_places_of(const model::Case &scene) {
    return scene.rotor.balancers.empty() ? std::vector<double>{} : attached_places_of(scene.rotor);
}

void add_outside(const model::Case &scene, const assembly::Discretization &d, MotionScene &motion) {
    const model::SimulateSettings &s = scene.simulate;
    for (const model::SuddenImbalance &imbalance : s.imbalances) {
        motion.parts.fixed.push_back(fixed_mass(imbalance, scene, d, motion.parts));
        motion.parts.fixed.back().from = imbalance.time;
    }
    for (const model::StationForce &force : s.forces)
        motion.parts.excitation.add(motion.parts.rotor.row(d.deflection_at(force.z)), force);
    if (s.base) {
        const reduction::ReducedRotor &rotor = motion.parts.rotor;
        const reduction::Row deviation =
            rotor.load_deviation.size() > 0 ? rotor.load_deviation : 0 * rotor.mass_load;
        motion.parts.excitation.set_base(rotor.mass_load + deviation, rotor.mass_load - deviation,
                                         *s.base);
    }
    motion.moment += moment_of_forces(s, motion.parts.rotor.mass, motion.fastest);
    for (const auto &[node, name] : forced::attached_nodes(d)) {
        motion.stations.rows.push_back(motion.parts.rotor.row(d.deflection_at_node(node)));
        motion.stations.z.push_back(d.shaft_mesh().nodes[static_cast<std::size_t>(node)]);
        motion.stations.names.push_back(name);
    }
}

} // namespace whirl::simulation
