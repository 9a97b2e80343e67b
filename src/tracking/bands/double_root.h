#pragma once

#include "modes/biorthogonal.h"

#include <Eigen/Core>

#include <functional>
#include <optional>

namespace whirl::tracking {

/// A speed at which two real eigenvalues meet and go on as a complex pair.
struct DoubleRoot {
    double speed = 0;           ///< rad/s
    double value = 0;           ///< of both, 1/s
    double noise = 0;           ///< how far rounding of the entries can move the speed, rad/s
    bool opens = false;         ///< they are real above the speed
    Eigen::VectorXd shape = {}; ///< of the motion there
};

/// The double real root of Q(l, speed) x = 0 next to a motion: Newton's method for g = 0 and
/// dg/dl = 0 in both unknowns, where g is the last unknown of the bordered system
/// [Q b; c^T 0] [x; g] = [0; 1], zero where Q is singular (W. Govaerts, Numerical Methods for
/// Bifurcations of Dynamical Equilibria, 2000, chapters 3 and 4: folds).
/// @param problem_at  Q at a speed, real
/// @param speed,value  rad/s and 1/s, to begin with
/// @param shape        of the motion there
/// @param reach        how far from `speed` to go, rad/s
/// @returns nothing where there is none in reach, or rounding hides where it is
[[nodiscard]] std::optional<DoubleRoot>
double_root(const std::function<modes::QuadraticAt(double)> &problem_at, double speed, double value,
            const Eigen::VectorXd &shape, double reach);

} // namespace whirl::tracking
