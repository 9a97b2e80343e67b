#pragma once

#include "modes/biorthogonal.h"

#include <Eigen/Core>

#include <complex>
#include <functional>
#include <optional>

namespace whirl::modes {

/// A speed at which two eigenvalues meet on a line, the real axis or the imaginary one, and leave
/// it as a pair on both sides of it.
template <class Scalar> struct DoubleRoot {
    double speed = 0;   ///< rad/s
    Scalar value = 0;   ///< of both, 1/s
    double noise = 0;   ///< how far rounding of the entries can move the speed, rad/s
    bool opens = false; ///< they are on the line above the speed
    Eigen::Matrix<Scalar, Eigen::Dynamic, 1> shape = {}; ///< of the motion there
};

/// The double root of Q(l, speed) x = 0 next to a motion: Newton's method for g = 0 and dg/dl = 0
/// in both unknowns, where g is the last unknown of the bordered system [Q b; c^H 0] [x; g] =
/// [0; 1], zero where Q is singular (W. Govaerts, Numerical Methods for Bifurcations of Dynamical
/// Equilibria, 2000, chapters 3 and 4: folds). Real: l is. Complex: l is imaginary, of a rotor
/// without damping, where Q is Hermitian at such an l and g real.
/// @param problem_at   Q at a speed
/// @param speed,value  rad/s and 1/s, to begin with
/// @param shape        of the motion there
/// @param reach        how far from `speed` to go, rad/s
/// @returns nothing where there is none in reach, or rounding hides where it is
template <class Scalar>
[[nodiscard]] std::optional<DoubleRoot<Scalar>>
double_root(const std::function<QuadraticAt(double)> &problem_at, double speed, Scalar value,
            const Eigen::Matrix<Scalar, Eigen::Dynamic, 1> &shape, double reach);

} // namespace whirl::modes
