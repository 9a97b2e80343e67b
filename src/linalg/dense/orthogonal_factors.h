#pragma once

#include <Eigen/Core>

namespace whirl::linalg {

/// A = Q R, columns of Q orthonormal, R triangular with nothing negative on its diagonal.
struct OrthogonalFactors {
    Eigen::MatrixXd Q;
    Eigen::MatrixXd R;
};

/// Of a matrix with no more columns than rows, by LAPACK's reflections (geqrf).
/// @throws SolverError where an entry is not finite
[[nodiscard]] OrthogonalFactors orthogonal_factors(Eigen::MatrixXd A);

} // namespace whirl::linalg
