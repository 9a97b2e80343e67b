#pragma once

#include "results/campbell.h"
#include "tracking/bands/locked_whirl.h"
#include "tracking/crossing_nodes.h"

#include <vector>

namespace whirl::tracking {

/// Intervals over which motions stand still in the rotor, from the ends of their bands inside the
/// range of the sweep: a motion enters at one and leaves at the next of the same line, or the last
/// that entered leaves. What stands still at a beginning of the range does so from there.
/// @param wanted  modes among which the motions that stand still at such a beginning are
[[nodiscard]] std::vector<results::Locked>
intervals_locked_to_rotor(const SweepNodes &sweep, std::vector<BandEnd> ends, int wanted);

/// Intervals over which a line lies on a multiple of the spin speed, other than by standing still
/// in the rotor: as the forward tilt of a free rotor with Ip = m Id. Ends inside the range (rows of
/// bearing tables) are refined to 1e-11.
[[nodiscard]] std::vector<results::Locked> intervals_on_multiple(const SweepNodes &sweep,
                                                                 double multiple);

} // namespace whirl::tracking
