#pragma once

#include "results/campbell.h"
#include "tracking/bands/locked_whirl.h"
#include "tracking/crossing_nodes.h"

#include <vector>

namespace whirl::tracking {

/// Intervals over which modes are locked to the rotor (at rest in rotating axes), from the ends of
/// their bands inside the range of the sweep: a mode enters at one and leaves at the next end of
/// the same line, or the last that entered leaves. Modes locked at the beginning of the range are
/// so from there.
/// @param wanted  modes that hold all locked ones at such a beginning
[[nodiscard]] std::vector<results::Locked>
intervals_locked_to_rotor(const SweepNodes &sweep, std::vector<BandEnd> ends, int wanted);

/// Intervals over which a line is locked on m times the spin speed other than by being at rest in
/// rotating axes: as the forward tilt of a free rotor with Ip = m Id. Ends inside the range (rows
/// of bearing tables) are refined to 1e-11.
[[nodiscard]] std::vector<results::Locked> intervals_on_multiple(const SweepNodes &sweep,
                                                                 double multiple);

} // namespace whirl::tracking
