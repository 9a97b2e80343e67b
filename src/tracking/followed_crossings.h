#pragma once

#include "tracking/crossing_nodes.h"

#include <vector>

namespace whirl::tracking {

/// A plain crossing of a followed motion with a multiple of the spin speed.
struct FollowedCrossing {
    std::size_t step; ///< of the sweep, from this speed to the next
    int line;
    double speed; ///< rad/s, a root to the accuracy of the eigenvalue
    double real;  ///< part of the eigenvalue there, 1/s
};

/// Crossings within steps through which one motion was followed, without another one near by, and
/// goes over from one side of the multiple to the other without turning back: by a secant method on
/// the motion alone (SpectrumSolver::near). What is not found so is left out.
[[nodiscard]] std::vector<FollowedCrossing> followed_crossings(const SweepNodes &nodes,
                                                               double multiple);

} // namespace whirl::tracking
