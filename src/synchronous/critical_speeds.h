#pragma once

#include "assembly/discretization.h"
#include "modes/whirl_mode.h"
#include "results/formulation.h"

#include <utility>
#include <vector>

namespace whirl::synchronous {

/// Modes whose frequency equals the spin speed (Im of the eigenvalue), ascending, at least
/// `wanted` or all; bearings as they are at `bearing_speed`. The sense of whirl is set.
/// @throws linalg::SolverError
[[nodiscard]] std::vector<modes::WhirlMode> synchronous_modes(const assembly::Discretization &rotor,
                                                              results::Form form,
                                                              double bearing_speed, int wanted);

/// Synchronous modes with the bearings as they are at each one's speed.
struct SynchronousModes {
    std::vector<modes::WhirlMode> modes; ///< ascending; the sense of whirl is set
    /// Symmetric forms: which eigenvalue of K - W^2 A passes zero at the mode (SynchronousRoot);
    /// empty for others.
    std::vector<int> branches;
    double complete_to = 0; ///< none below is missing, rad/s; infinity: the model has no more
    /// Speeds between which some may be missing, rad/s.
    std::vector<std::pair<double, double>> doubtful;
};

/// At least `wanted` lowest and all up to `top` (rad/s), where the model has so many.
/// @param symmetric  by the symmetric form where the rotor has one (SymmetricSynchronous)
/// @throws linalg::SolverError
[[nodiscard]] SynchronousModes all_synchronous_modes(const assembly::Discretization &rotor,
                                                     results::Form form, int wanted, double top,
                                                     bool symmetric = true);

} // namespace whirl::synchronous
