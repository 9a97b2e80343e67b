#pragma once

#include "oracles/case_rotor.h"

namespace whirl::oracles {

/// The `wanted` lowest whirl eigenvalues (1/s) of the continuum, Im > 0 ascending; a pair of a
/// round rotor at rest counts twice. Without damping isolated by counting; with damping from first
/// guesses by many two-node elements (dense_rotor.h). Cones: Richardson's extrapolation from
/// 48, 96 and 192 uniform slices, whose error is even in their length.
[[nodiscard]] std::vector<Complex> continuum_eigenvalues(const CaseRotor &rotor, double speed,
                                                         int wanted);

/// Frequencies (rad/s) of a uniform shaft pinned at both ends, rigid in shear, with rotary inertia:
/// (rho A + rho I k^2) w^2 -+ 2 rho I k^2 Omega w - E I k^4 = 0, k = n pi/L, ascending.
/// R.-J. Gibert, Vibrations des structures, pp 235-237, with rotary inertia added.
[[nodiscard]] std::vector<Real> pinned_rayleigh_frequencies(const Cylinder &shaft, double speed,
                                                            int wanted);

} // namespace whirl::oracles
