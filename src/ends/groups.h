#pragma once

#include <Eigen/Core>

#include <utility>
#include <vector>

namespace whirl::ends {

/// Numbers of rows and of columns that belong together.
using Group = std::pair<std::vector<int>, std::vector<int>>;

/// Which of the roots at both ends of a step could be one motion: groups, each of one root at
/// either end where that is clear.
/// @param off  misfit of each root at the one end (rows) with each at the other (columns)
[[nodiscard]] std::vector<Group> groups_of(Eigen::MatrixXd off);

} // namespace whirl::ends
