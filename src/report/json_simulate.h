#pragma once

#include "model/case.h"
#include "results/simulate.h"

#include <string>

namespace whirl::report {

/// The motion as JSON: outcome, residual_ratio, final angles, audit, time series.
[[nodiscard]] std::string to_json(const model::Case &scene, const results::SimulateResult &result);

/// One row for each output time: time, speed, amplitudes and deflections of the planes, angles.
[[nodiscard]] std::string to_csv(const results::SimulateResult &result);

} // namespace whirl::report
