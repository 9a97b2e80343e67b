#pragma once

#include "simulation/equations.h"

namespace whirl::simulation {

/// Something sets the rotor in motion: an imbalance, a balancer, or what [simulate] adds.
[[nodiscard]] bool has_drive(const model::Case &scene);

/// The rotor with a node wherever [simulate] lets something act: an imbalance without mass there.
[[nodiscard]] model::Rotor rotor_with_nodes(const model::Case &scene);

/// A speed for the scale of motions of a rotor that does not turn, rad/s: the fastest of the forces
/// in it, or else the bounce of the rotor as a rigid body; 0: there is none.
[[nodiscard]] double scale_at_rest(const model::Case &scene, const assembly::Discretization &d);

/// Forces and the motion of the foundation.
[[nodiscard]] std::vector<reduction::ReductionGoal::Outside>
loads_outside(const model::Case &scene);

/// The fastest motion that acts on a rotor spinning at up to this speed, rad/s, from outside:
/// forces, the foundation; weight, on whatever turns with the rotor without being round, at twice
/// the speed.
[[nodiscard]] double fastest_outside(const model::Case &scene, double speed);

/// Places of forces and of the deflections that count, ascending, m: of balancers, imbalances and
/// what [simulate] adds, and of all that is attached to a rotor without balancers.
[[nodiscard]] std::vector<double> places_of(const model::Case &scene);
/// Further places whose deflections count, m: with balancers those of all that is attached.
[[nodiscard]] std::vector<double> watched_places_of(const model::Case &scene);

/// The mass fixed in the rotor that a model::Imbalance or model::SuddenImbalance is.
template <class Imbalance>
[[nodiscard]] FixedMass fixed_mass(const Imbalance &imbalance, const model::Case &scene,
                                   const assembly::Discretization &d, const MovingParts &parts) {
    FixedMass out;
    out.row = parts.rotor.row(d.deflection_at(imbalance.z));
    out.mass.moment = imbalance.mr;
    out.mass.weight = imbalance.mr * scene.simulate.gravity;
    out.phase = imbalance.phase;
    return out;
}

/// Sudden imbalances, forces and the foundation; the stations.
void add_outside(const model::Case &scene, const assembly::Discretization &d, MotionScene &motion);

} // namespace whirl::simulation
