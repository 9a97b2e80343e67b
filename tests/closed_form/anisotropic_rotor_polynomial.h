#pragma once

#include "closed_form/anisotropic_rotor.h"

#include <array>

namespace whirl::closed_form {

/// Coefficients a0..a4 of a0 s^4 + a1 s^3 + ... + a4 in the rotating frame at spin speed Omega.
[[nodiscard]] std::array<double, 5> characteristic_polynomial(const AnisotropicRotor &rotor,
                                                              double spin_speed);

/// Routh-Hurwitz conditions of the quartic: all a_i > 0 and a1 a2 a3 - a0 a3^2 - a1^2 a4 > 0.
[[nodiscard]] bool routh_hurwitz_stable(const std::array<double, 5> &coefficients);

/// a1 a2 a3 - a0 a3^2 - a1^2 a4 in the closed form 4 h^2 p^2 [p^2 a^2 + h^2 + (2 - C)^2 Omega^2],
/// never negative: only a4 (and a0) decide stability.
[[nodiscard]] double hurwitz_determinant(const AnisotropicRotor &rotor, double spin_speed);

} // namespace whirl::closed_form
