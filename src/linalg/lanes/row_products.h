#pragma once

#include <Eigen/Core>
#include <Eigen/LU>

namespace whirl::linalg {

/// Small dense matrices by rows, which vector instructions go along.
using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using RowsIn = Eigen::Ref<const Rows, 0, Eigen::OuterStride<>>;
using RowsOut = Eigen::Ref<Rows, 0, Eigen::OuterStride<>>;

/// out = A B
void set_product(const RowsIn &A, const RowsIn &B, RowsOut out);
/// out += A B
void add_product(const RowsIn &A, const RowsIn &B, RowsOut out);

/// Of [A B], A square, by elimination with row pivoting: A^-1 B stands in the place of B, and
/// nothing of use in that of A.
/// @throws SolverError where A is singular
void solve_beside(Rows &both);

/// A complex matrix that is solved with for many right sides, real and imaginary parts apart.
class RowSolver {
  public:
    explicit RowSolver(const Eigen::MatrixXcd &A);

    /// A^-1 (re + i im) in the place of both, of as many columns as fill whole vectors
    /// (whole_vectors(), small_products.h).
    void solve(RowsOut re, RowsOut im) const;

  private:
    Eigen::PartialPivLU<Eigen::MatrixXcd> _lu;
    Eigen::VectorXcd _inverse; ///< of the diagonal of U
};

} // namespace whirl::linalg
