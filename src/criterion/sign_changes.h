#pragma once

#include "synchronous/receptance.h"

#include <Eigen/Core>

#include <vector>

namespace whirl::criterion {

/// All speeds in (from, to) at which an eigenvalue of the Hermitian part of R, over the imbalances
/// `range` (columns, over the rows of R), passes zero (or, without damping, infinity), ascending,
/// rad/s; some at which none does may be among them. With Z u = B s the work of the imbalances s is
/// zero with all its derivatives by s where Z u = B s, Z^H v = B s, B^H (u + v) = 0: between rows
/// of bearing tables a quadratic eigenproblem in the speed (mass coefficients that vary as in the
/// middle), of which every root near the real axis is looked for.
/// @throws linalg::SolverError where they cannot be resolved.
[[nodiscard]] std::vector<double> sign_changes(const synchronous::ForwardReceptance &receptance,
                                               const Eigen::MatrixXd &range, double from,
                                               double to);

} // namespace whirl::criterion
