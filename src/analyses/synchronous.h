#pragma once

#include "analyses/whirl_mode.h"
#include "assembly/discretization.h"

#include <vector>

namespace whirl::analyses {

/// Modes whose frequency equals the spin speed (Im of the eigenvalue), ascending, at least
/// `wanted` or all; bearings as they are at `bearing_speed`. The sense of whirl is set.
/// @throws linalg::SolverError
[[nodiscard]] std::vector<WhirlMode> synchronous_modes(const assembly::Discretization &rotor,
                                                       Form form, double bearing_speed, int wanted);

} // namespace whirl::analyses
