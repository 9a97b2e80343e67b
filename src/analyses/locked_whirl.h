#pragma once

#include "analyses/spectrum.h"

#include <cstddef>

namespace whirl::analyses {

/// The whirl of an asymmetric rotor that turns exactly with it, as over the band of speeds between
/// two of its critical speeds.
[[nodiscard]] bool locked(const WhirlMode &mode, double speed);

/// Speed (relative 1e-11) at which a motion that is locked at one speed ceases to be on the way to
/// another, where it is not. Its vectors coalesce with another's there, so it is known by its
/// eigenvalue in rotating axes.
[[nodiscard]] double end_of_lock(const SpectrumSolver &solver, const Spectrum &held,
                                 std::size_t held_place, const Spectrum &free,
                                 std::size_t free_place);

} // namespace whirl::analyses
