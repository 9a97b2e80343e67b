#pragma once

#include "model/rotor.h"
#include "results/held_motion.h"
#include "results/simulate.h"

namespace whirl::simulation {

/// The last part of the time that a speed is held, which the motion there is told by.
inline constexpr double told_by = 1.0 / 3;

/// The motion between two times at one speed, from the time series. It has settled where its two
/// halves have the same largest and root-mean-square deflections, and parts that stand still in
/// the rotor or turn in it at the same mean rate, and none creeps on that would come far.
///
/// @param series  amplitudes of the balancers' planes first, then of the stations
/// @param size    deflections smaller than a hundredth of this do not count, m
[[nodiscard]] results::HeldMotion motion_between(const model::Rotor &rotor,
                                                 const results::MotionSeries &series, double from,
                                                 double until, double size);

/// Jumps, and where up and down differ, from the motions of a sweep and, where they are known, the
/// steady states in which they came to rest.
void find_jumps(results::HeldSweep &sweep);

} // namespace whirl::simulation
