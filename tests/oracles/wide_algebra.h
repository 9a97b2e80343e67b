#pragma once

#include "oracles/continuum.h"

#include <Eigen/Core>

#include <vector>

namespace whirl::oracles {

using RealMatrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic>;
using ComplexMatrix = Eigen::Matrix<Complex, Eigen::Dynamic, Eigen::Dynamic>;

// Linear algebra of full matrices in long double, each once and written out: Eigen's, instantiated
// for these numbers, would take more time to compile than all other oracles.

/// A B, (n, m) of (n, k) and (k, m).
[[nodiscard]] RealMatrix product(const RealMatrix &A, const RealMatrix &B);

/// X of A X = B, by elimination with row pivots; A is (n, n) and regular, B (n, m).
[[nodiscard]] RealMatrix solve(RealMatrix A, RealMatrix B);
[[nodiscard]] ComplexMatrix solve(ComplexMatrix A, ComplexMatrix B);
[[nodiscard]] RealMatrix inverse(const RealMatrix &A);
[[nodiscard]] Real determinant(RealMatrix A);

/// Of a real (n, n) matrix, in no order, complex ones in exact pairs: Hessenberg form by
/// reflections, double steps of QR (Francis 1961; Golub, Van Loan, Matrix Computations, 7.5).
/// @throws std::runtime_error  without convergence
[[nodiscard]] std::vector<Complex> eigenvalues(const RealMatrix &A);

/// Of a Hermitian (n, n) matrix, ascending: Jacobi's rotations of its real form.
/// @throws std::runtime_error  without convergence
[[nodiscard]] std::vector<Real> hermitian_eigenvalues(const ComplexMatrix &A);

/// A z + B conj(z) on (Re z, Im z); (n, n) to (2 n, 2 n).
[[nodiscard]] RealMatrix real_form(const ComplexMatrix &A, const ComplexMatrix &B);

} // namespace whirl::oracles
