#pragma once

#include "model/case.h"
#include "results/weights.h"

#include <optional>

namespace whirl::analyses {

/// The highest speed at which the machine runs: operation.to, else the highest of the weights.
/// rad/s; none: the case does not say.
[[nodiscard]] std::optional<double> service_speed(const model::Case &scene);

/// How the rotor of a case is balanced by ISO 21940-12, and how many planes its bending motions
/// ask for (docs/theory.md, "Correction weights").
/// @param order  of the elements
/// @throws model::AnalysisFailure, linalg::SolverError where its critical speeds are not found
[[nodiscard]] results::BalancingProcedure balancing_procedure(const model::Case &scene,
                                                              double service_speed, int order);

} // namespace whirl::analyses
