#pragma once

#include <utility>
#include <vector>

namespace whirl::ends {

/// Intervals in which corresponding speeds lie among sorted lists, one list an arrangement of the
/// balls. Lists may lack speeds (outside the range, or two that coincide): each is laid on the
/// longest one in order so that the differences are least.
[[nodiscard]] std::vector<std::pair<double, double>>
intervals_of(const std::vector<std::vector<double>> &lists);

} // namespace whirl::ends
