#pragma once

#include "modes/biorthogonal.h"
#include "modes/spectrum.h"

namespace whirl::modes {

/// Basis of modes whose shapes and values are real: forms planar and hyperbolic.
[[nodiscard]] ModeBasis real_basis(const QuadraticAt &problem, const Spectrum &spectrum,
                                   results::Form form);

} // namespace whirl::modes
