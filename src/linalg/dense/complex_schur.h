#pragma once

#include <Eigen/Core>

namespace whirl::linalg {

/// A = Q T Q^H, T upper triangular, Q unitary.
struct ComplexSchurForm {
    Eigen::MatrixXcd Q, T;
};

/// By LAPACK (zgees). @throws SolverError where it does not converge
[[nodiscard]] ComplexSchurForm complex_schur(Eigen::MatrixXcd A);

} // namespace whirl::linalg
