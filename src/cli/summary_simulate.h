#pragma once

#include "analyses/simulate_result.h"
#include "model/case.h"

#include <string>

namespace whirl::cli {

/// The motion as text for a terminal.
[[nodiscard]] std::string summary(const model::Case &scene, const analyses::SimulateResult &result);

} // namespace whirl::cli
