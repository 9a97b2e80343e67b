#pragma once

#include <Eigen/Core>

namespace whirl::linalg {

/// A = U diag(s) V^H with as many columns of U and V as A has of its smaller dimension.
struct SingularValues {
    Eigen::MatrixXcd U;
    Eigen::VectorXd s; ///< descending
    Eigen::MatrixXcd V;
};

/// By Jacobi's rotations. Empty factors where A is empty; NaN where it is not finite.
[[nodiscard]] SingularValues singular_values(const Eigen::MatrixXcd &A);

} // namespace whirl::linalg
