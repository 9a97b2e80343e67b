#pragma once

#include "results/formulation.h"
#include "synchronous/parts.h"

namespace whirl::synchronous {

/// Synchronous modes of a damped or coupled rotor with bearing tables: eigenvalues l(s) with the
/// coefficients of the bearings at s for which Im l(s) = s. Between two rows the coefficients are
/// linear in s; the eigenvalues at both ends, of which none is missing, are matched one to one by
/// their derivatives (left and right vectors), and each one's Im l - s is looked at as the cubic
/// through values and derivatives. Steps in which a match or the number of zeros is doubtful are
/// halved. Zeros are refined on the problem itself.
/// @param form  general or rotating; the rotor has bearing tables
/// @returns at least `wanted` and all up to `top` (rad/s), where the model has so many; without the
///          sense of whirl
/// @throws linalg::SolverError
[[nodiscard]] SynchronousModes followed_modes(const assembly::Discretization &rotor,
                                              results::Form form, int wanted, double top);

} // namespace whirl::synchronous
