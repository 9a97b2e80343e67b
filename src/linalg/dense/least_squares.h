#pragma once

#include <Eigen/Core>

namespace whirl::linalg {

/// x of least |A x - b|, and of all of these the shortest: orthogonal factors with column pivots
/// (LAPACK's gelsy). Where A is smaller than its rounding it counts as singular. A is (n, m), b
/// (n); NaN where one of them is not finite.
[[nodiscard]] Eigen::VectorXd least_squares(Eigen::MatrixXd A, const Eigen::VectorXd &b);
/// Of each column of B, (n, k); (m, k).
[[nodiscard]] Eigen::MatrixXcd least_squares(Eigen::MatrixXcd A, const Eigen::MatrixXcd &B);

} // namespace whirl::linalg
