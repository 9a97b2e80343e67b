#pragma once

#include "ends/stability_ends.h"
#include "stability/unstable_bands.h"

#include <vector>

namespace whirl::ends {

/// Where something grows by the ends: the unstable bands of the range.
[[nodiscard]] std::vector<results::Interval> bands_of(const EndsFound &found,
                                                      const results::Interval &range);

/// Ends of a rotor whose equations stay periodic: as many motions grow as Floquet multipliers lie
/// outside of the unit circle. Where neighbouring speeds differ in that number it is bisected.
/// @param speeds  ascending; a change that is undone before the next of them or the next end of a
///                band is not seen
[[nodiscard]] EndsFound multiplier_ends(const stability::MotionsAt &at,
                                        const std::vector<double> &speeds,
                                        const std::vector<results::Interval> &bands);

} // namespace whirl::ends
