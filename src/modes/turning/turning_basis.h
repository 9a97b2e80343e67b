#pragma once

#include "modes/biorthogonal.h"
#include "modes/spectrum.h"

namespace whirl::modes {

/// Left and right vectors of the modes of a spectrum in rotating axes (form rotating), with rates
/// as seen from the fixed frame.
/// @param problem   at the speed of the spectrum
/// @param mirrored  as in basis_of
[[nodiscard]] ModeBasis turning_basis(const QuadraticAt &problem, const Spectrum &spectrum,
                                      bool mirrored);

} // namespace whirl::modes
