#pragma once

#include "linalg/lanes/row_products.h"

#include <Eigen/Core>

namespace whirl::linalg {

/// A = Q R, columns of Q orthonormal, R triangular with nothing negative on its diagonal.
struct OrthogonalFactors {
    Rows Q;
    Eigen::MatrixXd R;
};

/// Of a matrix with no more columns than rows, by Cholesky factors of A^T A, twice, or by
/// reflections where A is nearly singular.
/// @throws SolverError where an entry is not finite
[[nodiscard]] OrthogonalFactors orthogonal_factors(const Rows &A);

} // namespace whirl::linalg
