#pragma once

#include <Eigen/Core>

#include <optional>

namespace whirl::linalg {

/// L of A = L L^T, A symmetric (n, n), of which the lower half is read (LAPACK's potrf); nothing
/// where A is not positive definite.
[[nodiscard]] std::optional<Eigen::MatrixXd> cholesky(Eigen::MatrixXd A);

/// Eigenvalues l, ascending, of A x = l B x, both symmetric (n, n), of which the lower halves are
/// read, B positive definite (LAPACK's sygv); nothing where B is not, or where the iteration does
/// not converge.
[[nodiscard]] std::optional<Eigen::VectorXd> symmetric_pair_values(Eigen::MatrixXd A,
                                                                   Eigen::MatrixXd B);

} // namespace whirl::linalg
