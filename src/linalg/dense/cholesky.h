#pragma once

#include <Eigen/Core>

#include <optional>

namespace whirl::linalg {

/// L of A = L L^T, A symmetric (n, n), of which the lower half is read (LAPACK's potrf); nothing
/// where A is not positive definite.
[[nodiscard]] std::optional<Eigen::MatrixXd> cholesky(Eigen::MatrixXd A);

} // namespace whirl::linalg
