#pragma once

#include <Eigen/Core>

namespace whirl::linalg {

/// A = Q R, columns of Q orthonormal, R triangular with nothing negative on its diagonal.
struct OrthogonalFactors {
    Eigen::MatrixXd Q, R;
};

/// Of a matrix with no more columns than rows, by reflections (LAPACK's geqrf).
/// @throws SolverError where an entry is not finite
[[nodiscard]] OrthogonalFactors orthogonal_factors(Eigen::MatrixXd A);

} // namespace whirl::linalg
