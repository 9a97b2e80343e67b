#pragma once

#include <Eigen/Core>

namespace whirl::linalg {

/// A^-1 b for a small dense regular matrix.
[[nodiscard]] Eigen::VectorXcd solve_small(const Eigen::MatrixXcd &A, const Eigen::VectorXcd &b);

} // namespace whirl::linalg
