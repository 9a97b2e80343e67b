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

enum class Vectors { right, both };

/// By the QR algorithm with double shifts (LAPACK's dlahqr), without balancing: it takes an entry
/// for zero only beside its neighbours, so that small eigenvalues stay beside large ones (creeping
/// motions between strong dampers), which dgeev loses.
/// @param which  right alone: `left` and `products` are of no use
/// @throws SolverError where it does not converge
[[nodiscard]] GeneralEigen general_eigen(Eigen::MatrixXd A, Vectors which);

/// The eigenvalues alone, by the same algorithms at a third of the cost.
/// @throws SolverError where they do not converge
[[nodiscard]] Eigen::VectorXcd general_eigenvalues(Eigen::MatrixXd A);
[[nodiscard]] Eigen::VectorXcd complex_eigenvalues(Eigen::MatrixXcd A);

/// The same of a complex matrix, in complex numbers.
struct ComplexEigen {
    Eigen::VectorXcd values;
    Eigen::MatrixXcd right, left; ///< A v = value v and u^H A = value u^H, a column each
    Eigen::VectorXcd products;    ///< u^H v of each value
};

/// The same of a complex matrix (LAPACK's zlahqr), right and left vectors.
/// @throws SolverError where it does not converge
[[nodiscard]] ComplexEigen general_eigen(Eigen::MatrixXcd A);

/// The same with right vectors by Eigen's QR algorithm, slower: what rounding makes of defective
/// eigenvalues differs, and with it what they hide of others.
/// @throws SolverError where it does not converge
[[nodiscard]] GeneralEigen general_eigen_otherwise(const Eigen::MatrixXd &A);

/// a^H b of columns j (real), or j and j + 1 (real and imaginary parts).
[[nodiscard]] std::complex<double>
packed_product(const Eigen::MatrixXd &a, const Eigen::MatrixXd &b, Eigen::Index j, bool pair);

/// Column j, or columns j and j + 1, as one vector.
[[nodiscard]] Eigen::VectorXcd unpacked(const Eigen::MatrixXd &a, Eigen::Index j, bool pair);

} // namespace whirl::linalg
