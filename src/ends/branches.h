#pragma once

#include "ends/spectrum.h"
#include "modes/roots/branches.h"

#include <optional>

namespace whirl::ends {

using modes::Branch;
using modes::Branches;
using modes::followed;

/// Where in a step (between 0 and 1) another spectrum is needed before the signs of all real parts
/// are known throughout; nothing: they are.
///  - a motion could not be followed,
///  - a real part may pass zero twice, or its cubic is not to be trusted,
///  - two motions pass each other in frequency: coupling, however weak, shows right there, unless
///    it is known to be too weak (coupling.h).
/// @param from,to  at the ends of the step
/// @param scale  speed below whose rounding frequencies are equal, rad/s
[[nodiscard]] std::optional<double> where_to_refine(const Branches &branches, const Spectrum &from,
                                                    const Spectrum &to, double scale);

} // namespace whirl::ends
