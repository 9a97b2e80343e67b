#pragma once

#include "linalg/eigenpair.h"
#include "linalg/matrix.h"

#include <vector>

namespace whirl::linalg {

/// What ShiftedPencil is asked for.
struct ShiftedOptions {
    Eigen::MatrixXd null_space; ///< of K, one vector a column
    double s = 0;               ///< the parameter (spin speed)
    double shift = 0;           ///< real, not an eigenvalue, rad/s
    int wanted = 0;             ///< eigenvalues of least modulus, zeros included
};

/// Eigenvalues w of Q(w) x = (K + w s S - w^2 M) x = 0 as in DefinitePencil, but with K singular:
/// free rigid motions. With K = L L^T (as many zero columns as K has null vectors), M = F F^T and
/// P = Q(shift)^-1, 1/(w - shift) are the eigenvalues of the symmetric matrix
///
///     [shift F^T P F,  F^T P L;  L^T P F,  (L^T P L - I) / shift].
///
/// Returns at least `wanted` pairs of least modulus, ascending, complete up to the last by the
/// inertia of Q at two shifts. Vectors have x^T K x + w^2 x^T M x = 1, or unit mass where w = 0.
/// @throws SolverError where the count cannot be met.
[[nodiscard]] std::vector<RealPair> solve_shifted(const Matrix &K, const Matrix &M, const Matrix &S,
                                                  const ShiftedOptions &options);

} // namespace whirl::linalg
