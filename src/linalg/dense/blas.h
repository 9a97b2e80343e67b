#pragma once

#include <Eigen/Core>

namespace whirl::linalg {

/// C + A B by BLAS, which knows the machine: for products that are most of the work.
[[nodiscard]] Eigen::MatrixXd sum_with_product(Eigen::MatrixXd C, const Eigen::MatrixXd &A,
                                               const Eigen::MatrixXd &B);
[[nodiscard]] Eigen::MatrixXd product(const Eigen::MatrixXd &A, const Eigen::MatrixXd &B);
[[nodiscard]] Eigen::VectorXd product(const Eigen::MatrixXd &A, const Eigen::VectorXd &b);

/// X with A X = B, by LAPACK. @throws SolverError where A is singular
[[nodiscard]] Eigen::MatrixXd solution(Eigen::MatrixXd A, Eigen::MatrixXd B);

} // namespace whirl::linalg
