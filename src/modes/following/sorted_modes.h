#pragma once

#include "modes/general_spectrum.h"
#include "modes/whirl_mode.h"

#include <complex>

namespace whirl::modes {

/// Sorts an eigenpair in: a whirl mode, or motion without whirl.
/// @param value  of the mode, with the sign of its whirl where the form has one
void sort_in(std::complex<double> value, WhirlMode mode, GeneralSpectrum::Modes &out);

/// Form planar_damped: the eigenvalue and the direction of whirl, the sign of its Im.
/// @param positive  that sign, where the eigenvalue is zero too
void set_planar_whirl(WhirlMode &mode, std::complex<double> value, bool positive, double speed);

} // namespace whirl::modes
