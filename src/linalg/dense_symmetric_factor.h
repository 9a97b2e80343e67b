#pragma once

#include <Eigen/Core>

#include <complex>

namespace whirl::linalg {

/// L D L^T of small full matrices that are complex and symmetric (not Hermitian). Rows are not
/// exchanged: whoever solves with it looks at the residual.
class DenseSymmetricFactor {
  public:
    /// Of a matrix given by its parts, of which the lower triangles count.
    /// @throws SolverError where a pivot is zero or not a number.
    void factorize(const Eigen::MatrixXd &re, const Eigen::MatrixXd &im);

    [[nodiscard]] Eigen::VectorXcd solve(const Eigen::VectorXcd &b) const;
    [[nodiscard]] Eigen::Index size() const { return _re.rows(); }

  private:
    Eigen::MatrixXd _re, _im;                 ///< L
    Eigen::VectorXd _inverse_re, _inverse_im; ///< of the pivots
    Eigen::VectorXd _row_re, _row_im;
};

} // namespace whirl::linalg
