#pragma once

#include "results/formulation.h"
#include "synchronous/parts.h"
#include "synchronous/reduced.h"

#include <vector>

namespace whirl::synchronous {

/// Modes whose frequency equals the spin speed, a positive one (Im of the eigenvalue), ascending,
/// at least `wanted` or all; bearings as they are at `bearing_speed`. The sense of whirl is set.
/// @throws linalg::SolverError
[[nodiscard]] std::vector<modes::WhirlMode> synchronous_modes(const assembly::Discretization &rotor,
                                                              results::Form form,
                                                              double bearing_speed, int wanted);

/// The same with the bearings as they are at each one's speed: at least `wanted` lowest and all up
/// to `top` (rad/s), where the model has so many.
/// @param top     of |spin speed|
/// @param shared  shapes to begin with; none: the rotor's own
/// @param spin    sign of the spin speed
/// @throws linalg::SolverError
[[nodiscard]] SynchronousModes all_synchronous_modes(const assembly::Discretization &rotor,
                                                     results::Form form, int wanted, double top,
                                                     const SharedShapes *shared = nullptr,
                                                     int spin = 1);

/// For rotors of which this one is the softest.
/// @param reach  up to which their critical speeds are wanted, rad/s
/// @throws linalg::SolverError
[[nodiscard]] SharedShapes shared_shapes(const assembly::Discretization &rotor, double reach,
                                         int wanted);

} // namespace whirl::synchronous
