#pragma once

#include "report/common/json.h"
#include "report/report.h"
#include "results/level1.h"

namespace whirl::report {

// Level-I stability as a part of the report of `stability`.

[[nodiscard]] Json level1_json(const results::Level1 &level1);
/// Table of what was found, and the curve as a table of its own in the picture's CSV.
[[nodiscard]] Section level1_section(const results::Level1 &level1);
[[nodiscard]] std::string level1_text(const results::Level1 &level1);
/// Logarithmic decrement over added cross coupling, with its CSV.
[[nodiscard]] Picture level1_picture(const model::Case &scene, const results::Level1 &level1);

} // namespace whirl::report
