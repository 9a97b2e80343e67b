#pragma once

#include "report/common/units.h"
#include "results/samples.h"

#include <string>

namespace whirl::report {

/// An answer of many rotors in words: "critical forward 1".
[[nodiscard]] std::string answer_text(const results::SampledAnswer &answer, const Units &units);

} // namespace whirl::report
