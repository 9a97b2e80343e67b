#pragma once

#include "report/common/units.h"
#include "results/samples.h"

#include <cstddef>
#include <string>
#include <vector>

namespace whirl::report {

/// An answer of many rotors in words: "critical forward 1".
[[nodiscard]] std::string answer_text(const results::SampledAnswer &answer, const Units &units);

/// Why a rotor (from 0) has no answer; empty: it has.
[[nodiscard]] std::string failure_of(const std::vector<results::SampleFailure> &failures,
                                     int rotor);

/// Of `count` places at most so many, evenly spread, with the first and the last.
/// @param most  2 or more
[[nodiscard]] std::vector<std::size_t> spread_over(std::size_t count, std::size_t most);

} // namespace whirl::report
