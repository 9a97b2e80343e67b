#pragma once

#include "synchronous/branch.h"
#include "synchronous/parts.h"
#include "synchronous/problem.h"

#include <Eigen/Core>

namespace whirl::synchronous {

/// All synchronous roots of a reduced rotor, each found again on the whole one.
/// With bearing tables eigenvalues l(s) with the bearings as at s for which Im l(s) = s: between
/// two rows the coefficients are linear in s; values and rates of the eigenvalues at both ends say
/// which becomes which (modes::followed), and the cubics through them where Im l - s passes zero.
/// Steps in which that is doubtful are halved. Of a conservative problem the roots found are
/// counted by the inertia of the whole one in every gap between them.
/// @param roots   of the problem
/// @param shapes  N x r planar shapes (synchronous_shapes)
/// @returns at least `wanted` and all up to `top` (rad/s), where the reduced rotor has so many;
///          without the sense of whirl; complete_to infinite where the shapes are all unknowns
/// @throws linalg::SolverError
[[nodiscard]] SynchronousModes followed_modes(const SynchronousProblem &problem,
                                              const WholeRoots &roots,
                                              const Eigen::MatrixXd &shapes, int wanted,
                                              double top);

} // namespace whirl::synchronous
