#pragma once

#include "model/case.h"
#include "results/simulate.h"

#include <string>

namespace whirl::report {

/// The report page of a motion. `picture`: the SVG shown where the page cannot be interactive.
[[nodiscard]] std::string to_html(const model::Case &scene, const results::SimulateResult &result,
                                  const std::string &picture);

} // namespace whirl::report
