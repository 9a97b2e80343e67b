#pragma once

#include "ends/stability_ends.h"
#include "stability/unstable_bands.h"

#include <vector>

namespace whirl::ends {

/// Where something grows by the ends: the unstable bands of the range.
[[nodiscard]] std::vector<results::Interval> bands_of(const EndsFound &found,
                                                      const results::Interval &range);

/// Reconciles stability limits with unstable ranges. An end at which growth begins or ceases
/// altogether is the band's end, to the last digit; bands that only the ends know are taken up, and
/// so are ends of bands that only the search for bands knows: collisions of undamped motions.
/// @param at    motions at a speed, for how many grow inside of such a band
/// @param form  whose axes their frequencies are in
/// Where ends do not explain those of the bands, the bands stay as they are.
/// @returns ends of bands at which the number of growing motions is not known to change
[[nodiscard]] std::vector<double> reconcile(EndsFound &found, std::vector<results::Interval> &bands,
                                            const stability::MotionsAt &at, results::Form form,
                                            const results::Interval &range);

/// Ends of a rotor whose equations stay periodic: as many motions grow as Floquet multipliers lie
/// outside of the unit circle. Where neighbouring speeds differ in that number it is bisected.
/// @param speeds  ascending; a change that is undone before the next of them or the next end of a
///                band is not seen
[[nodiscard]] EndsFound multiplier_ends(const stability::MotionsAt &at,
                                        const std::vector<double> &speeds,
                                        const std::vector<results::Interval> &bands);

} // namespace whirl::ends
