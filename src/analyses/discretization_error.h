#pragma once

#include "analyses/formulation.h"
#include "model/case.h"

namespace whirl::analyses {

/// Order of the shaft elements: the given one, or with order = "auto" the lowest of a ladder at
/// which the estimated error of the frequencies asked for meets the tolerance of the case.
/// @throws model::AnalysisFailure where the highest order does not meet it.
[[nodiscard]] int resolve_order(const model::Case &scene, const Formulation &formulation);

} // namespace whirl::analyses
