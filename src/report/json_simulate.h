#pragma once

#include "analyses/simulate_result.h"
#include "model/case.h"

#include <string>

namespace whirl::report {

/// The motion as JSON: outcome, residual_ratio, final angles, audit, time series.
[[nodiscard]] std::string to_json(const model::Case &scene, const analyses::SimulateResult &result);

/// One row for each output time: time, speed, amplitudes and deflections of the planes, angles.
[[nodiscard]] std::string to_csv(const analyses::SimulateResult &result);

} // namespace whirl::report
