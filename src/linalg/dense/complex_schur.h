#pragma once

#include <Eigen/Core>

namespace whirl::linalg {

/// A = Q T Q^H, T upper triangular, Q unitary.
struct ComplexSchurForm {
    Eigen::MatrixXcd Q, T;
};

/// By LAPACK (zgees). @throws SolverError where it does not converge
[[nodiscard]] ComplexSchurForm complex_schur(Eigen::MatrixXcd A);

/// Eigenvalues of a complex matrix with its right and left eigenvectors: A v = value v and
/// u^H A = value u^H, a column each.
struct ComplexEigen {
    Eigen::VectorXcd values;
    Eigen::MatrixXcd right, left;
};

/// By LAPACK (zgeev). @throws SolverError where it does not converge
[[nodiscard]] ComplexEigen complex_eigen(Eigen::MatrixXcd A);

} // namespace whirl::linalg
