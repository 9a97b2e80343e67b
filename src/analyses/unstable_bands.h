#pragma once

#include "analyses/motions.h"

#include <functional>
#include <utility>
#include <vector>

namespace whirl::analyses {

/// An open interval of spin speed, rad/s.
using SpeedInterval = std::pair<double, double>;

using MotionsAt = std::function<std::vector<Motion>(double speed)>;

/// Unstable spin speeds between the first and the last of `speeds`, ends refined as roots
/// (relative 1e-10), an end at the border of the range where instability reaches it.
///
/// Bands far narrower than the grid are found: motions are followed from speed to speed by their
/// states, and wherever two of them meet in frequency (or cannot be told apart) the mean s and
/// the squared half difference q of their eigenvalues, which are smooth in the speed even where
/// the eigenvalues s +- sqrt(q) are not, lead to the place where s + sqrt(q) grows most. A meeting
/// opens a band where the two have opposite signature. A stable window between two unstable speeds
/// is looked for where different motions grow at them. Growth that sinks below what rounding lets
/// one see without having been zero (balls near rest: a power of the speed) is carried on.
///
/// @param speeds  ascending, at least two
[[nodiscard]] std::vector<SpeedInterval> unstable_bands(const MotionsAt &at,
                                                        const std::vector<double> &speeds);

/// Where instability is strongest in a band found, rad/s.
[[nodiscard]] double strongest_speed(const MotionsAt &at, const SpeedInterval &band);

/// What both lists of bands have in common.
[[nodiscard]] std::vector<SpeedInterval> common(const std::vector<SpeedInterval> &a,
                                                const std::vector<SpeedInterval> &b);

/// Joins bands that touch or overlap; ascending.
[[nodiscard]] std::vector<SpeedInterval> joined(std::vector<SpeedInterval> bands);

} // namespace whirl::analyses
