#pragma once

#include "model/rotor.h"
#include "results/formulation.h"

#include <vector>

namespace whirl::stability {

/// |l| up to which motions are slow enough to be looked at, 1/s: `least`, as much more as leaves
/// eight at each speed, and on into the widest gap up to twice as far.
/// @param sizes  |l| of all motions at some speeds over the range, a list each, in any order
[[nodiscard]] double motion_reach(std::vector<std::vector<double>> sizes, double least);

/// Bearings can feed energy into any motion, not only slow ones: cross-coupled stiffness that is
/// not symmetric, or damping that is negative in some direction. So can an axial torque, which may
/// have no potential.
[[nodiscard]] bool bearings_drive(const model::Rotor &rotor);

/// Motions looked at, however fast they are: more where bearings drive.
[[nodiscard]] int fewest_motions(const model::Rotor &rotor);

/// |Im l| up to which motions can begin or cease to grow, rad/s. On the imaginary axis the work of
/// the forces is zero: w x^H C x = i x^H N x with the symmetric part C of the damping and the skew
/// part N of the stiffness. In fixed axes w is therefore no larger than the largest such quotient
/// of a single bearing, and the spin speed for the damping of the shaft itself; in rotating axes,
/// where N of a bearing has its C times the speed in it, than the sum of both. Infinite where
/// something drives motions of every frequency: negative damping, cross coupling without damping, a
/// torque without a potential.
/// @param speed  |spin speed|, or the largest of a range, rad/s
[[nodiscard]] double growth_reach(const model::Rotor &rotor, results::Form form, double speed);

} // namespace whirl::stability
