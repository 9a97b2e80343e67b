#pragma once

#include "model/case.h"
#include "results/simulate.h"

#include <string>

namespace whirl::cli {

/// The motion as text for a terminal.
[[nodiscard]] std::string summary(const model::Case &scene, const results::SimulateResult &result);

} // namespace whirl::cli
