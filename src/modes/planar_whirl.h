#pragma once

#include "modes/whirl_mode.h"

#include <complex>

namespace whirl::modes {

/// Form planar_damped: the eigenvalue and the direction of whirl, the sign of its Im.
/// @param positive  that sign, where the eigenvalue is zero too
void set_planar_whirl(WhirlMode &mode, std::complex<double> value, bool positive, double speed);

/// Modes of the real form of a rotor that is the same from every direction as modes of form
/// planar_damped. Of (x, y), x + i y whirls with exp(l t) and the conjugate of x - i y with
/// exp(conj(l) t). Both are there where two directions share an eigenvalue, as at rest; then each
/// of the modes stands for one of them.
[[nodiscard]] Spectrum as_planar(Spectrum found, double speed);

} // namespace whirl::modes
