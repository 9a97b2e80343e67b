#pragma once

#include <Eigen/Core>

#include <complex>

namespace whirl::linalg {

/// Eigenvalues of a real matrix with its right and left eigenvectors, in real numbers.
struct GeneralEigen {
    Eigen::VectorXcd values; ///< of a conjugate pair the one with Im > 0 comes first
    /// A v = value v and u^H A = value u^H, a column each; of a conjugate pair u + i v of the first
    /// value in two columns: u, v.
    Eigen::MatrixXd right, left;
    /// u^H v of each value.
    Eigen::VectorXcd products;

    [[nodiscard]] bool is_pair(Eigen::Index i) const { return values(i).imag() > 0; }
};

/// By the QR algorithm of LAPACK, both kinds of vectors from one Schur form, without balancing.
/// @throws SolverError where it does not converge
[[nodiscard]] GeneralEigen general_eigen(Eigen::MatrixXd A);

/// a^H b of columns j (real), or j and j + 1 (real and imaginary parts).
[[nodiscard]] std::complex<double> packed_product(const Eigen::MatrixXd &a,
                                                  const Eigen::MatrixXd &b, Eigen::Index j,
                                                  bool pair);

} // namespace whirl::linalg
