#pragma once

#include <Eigen/Core>

#include <complex>
#include <vector>

namespace whirl::linalg {

/// A real eigenpair of Q(w) x = 0 with a symmetric definite pencil; see DefinitePencil.
struct RealPair {
    double value = 0;       ///< w, rad/s
    Eigen::VectorXd vector; ///< x with x^T K x + w^2 x^T M x = 1
    double residual = 0;    ///< bound on the relative error of w left by the iteration
    double rounding = 0;    ///< relative error that rounding of the matrix entries can cause
};

/// An eigenpair of (l^2 M + l D + K) x = 0 with real matrices.
struct ComplexPair {
    std::complex<double> value; ///< l, 1/s
    Eigen::VectorXcd vector;    ///< largest modulus 1
    double residual = 0;        ///< relative change of l that would explain the remaining residual
    double rounding = 0;        ///< relative error that rounding of the matrix entries can cause
    Eigen::VectorXcd left = {}; ///< y with y^T Q(l) = 0, of any length; empty: not asked for
};

} // namespace whirl::linalg
