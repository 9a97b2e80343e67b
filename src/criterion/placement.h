#pragma once

#include "criterion/rotor.h"
#include "results/balance.h"

namespace whirl::criterion {

/// The criterion with one plane anywhere along the shaft, over the range of speeds, and with two
/// planes anywhere at the highest speed; the places that balance the largest share of the range,
/// among equal ones those with the largest margin. Shares are read off a grid of at least 81
/// speeds, with the signs interpolated between them. Collective; complete on process 0.
///
/// @param critical  undamped critical speeds in the range, where signs jump, rad/s
/// @throws model::AnalysisFailure, linalg::SolverError
[[nodiscard]] results::Placement placement(const BalanceScene &scene,
                                           const assembly::Discretization &d,
                                           const std::vector<double> &critical);

} // namespace whirl::criterion
