#pragma once

#include "criterion/rotor.h"
#include "results/pendulum.h"
#include "results/sentence.h"

#include <string>
#include <vector>

namespace whirl::criterion {

/// Efficiency of the four-pendulum balancers of a case over its speeds; empty without any.
///
/// Planar closed form: the rotor with the pendulums' masses in its lowest forward critical mode
/// that moves at the balancer, scaled to 1 there, gives M_Sigma, c and H_2 (exact for a rigid rotor
/// that stays parallel to itself). Flexible shaft: every steady motion found, with its stability.
/// Driven by the imbalances of the balancers, or where those have none by [[imbalance]]; bearings
/// with the mean of x and y.
///
/// @param notes  gets what a user must know of the assumptions
/// @throws model::BadInput where a pendulum has no pivot radius; model::AnalysisFailure without a
///         forward critical speed; linalg::SolverError
[[nodiscard]] std::vector<results::PendulumBalance>
pendulum_balance(const model::Case &scene, const BalanceScene &shared,
                 std::vector<results::Sentence> &notes);

} // namespace whirl::criterion
