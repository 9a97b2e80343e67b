#pragma once

#include <Eigen/Core>

namespace whirl::periodic {

constexpr int stages = 8; ///< even, for conjugate pairs of roots; order 15 needs few steps

/// Collocation at the s = 8 right Radau points, order 15 (Radau IIA; E. Hairer, G. Wanner, Solving
/// Ordinary Differential Equations II, 2nd ed., section IV.5): slow motions are as exact as of a
/// spectral element, and motions far too fast for the step die out instead of turning up as others.
///
/// The inverse of its matrix is T diag(roots) T^-1, roots and columns of T in conjugate pairs, of
/// which one is listed: a sum over all is twice the real part of the sum over these.
struct Collocation {
    Eigen::VectorXd nodes;   ///< in (0, 1], the last one 1
    Eigen::MatrixXd inverse; ///< of the method's matrix, s x s
    Eigen::VectorXcd roots;  ///< s/2
    Eigen::MatrixXcd T;      ///< s x s/2
    Eigen::MatrixXcd left;   ///< rows of T^-1, s/2 x s
};

/// Made once.
[[nodiscard]] const Collocation &collocation();

/// Step times frequency up to which a step of a harmonic motion is exact to 2e-12, rad; of
/// half that frequency to rounding.
constexpr double resolved_angle = 2.2;

} // namespace whirl::periodic
