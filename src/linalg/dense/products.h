#pragma once

// Products of whole matrices and solves with factors of them, compiled once: as expressions each
// combination of blocks, transposes and scalars costs the compiler up to two seconds.

#include <Eigen/Core>
#include <Eigen/LU>

namespace whirl::linalg {

/// Stored by rows.
using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// A B
[[nodiscard]] Eigen::MatrixXd times(const Eigen::MatrixXd &A, const Eigen::MatrixXd &B);
[[nodiscard]] Eigen::MatrixXcd times(const Eigen::MatrixXcd &A, const Eigen::MatrixXcd &B);
[[nodiscard]] Eigen::VectorXcd times(const Eigen::MatrixXcd &A, const Eigen::VectorXcd &x);

/// A^T B, A^H B
[[nodiscard]] Eigen::MatrixXd transposed_times(const Eigen::MatrixXd &A, const Eigen::MatrixXd &B);
[[nodiscard]] Eigen::MatrixXcd transposed_times(const Eigen::MatrixXcd &A,
                                                const Eigen::MatrixXcd &B);
[[nodiscard]] Eigen::MatrixXcd adjoint_times(const Eigen::MatrixXcd &A, const Eigen::MatrixXcd &B);

/// T^T A T
[[nodiscard]] Eigen::MatrixXd congruent(const Eigen::MatrixXd &A, const Eigen::MatrixXd &T);

/// A^-1 B
[[nodiscard]] Eigen::MatrixXd solved(const Eigen::PartialPivLU<Eigen::MatrixXd> &A,
                                     const Eigen::MatrixXd &B);
[[nodiscard]] Eigen::MatrixXcd solved(const Eigen::PartialPivLU<Eigen::MatrixXcd> &A,
                                      const Eigen::MatrixXcd &B);
[[nodiscard]] Eigen::VectorXcd solved(const Eigen::PartialPivLU<Eigen::MatrixXcd> &A,
                                      const Eigen::VectorXcd &b);
/// A lower bound of 1 / (|A| |A^-1|), norms of columns.
[[nodiscard]] double reciprocal_condition(const Eigen::PartialPivLU<Eigen::MatrixXcd> &A);

} // namespace whirl::linalg
