#pragma once

#include "results/interval.h"

#include <vector>

namespace whirl::ends {

/// Intervals in which corresponding speeds lie among sorted lists, one list an arrangement of the
/// balls. Lists may lack speeds (outside the range, or two that coincide): each is laid on the
/// longest one in order so that the differences are least.
[[nodiscard]] std::vector<results::Interval>
intervals_of(const std::vector<std::vector<double>> &lists);

} // namespace whirl::ends
