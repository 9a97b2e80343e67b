#pragma once

#include "stability/motions.h"

#include <functional>
#include <map>
#include <utility>
#include <vector>

namespace whirl::stability {

/// An open interval of spin speed, rad/s.
using SpeedInterval = std::pair<double, double>;

using MotionsAt = std::function<std::vector<Motion>(double speed)>;

/// Growth at speeds looked at, ascending: above zero unstable, below stable, zero not decided.
using Known = std::map<double, double>;

struct BandsFound {
    std::vector<SpeedInterval> bands;    ///< ascending, apart
    std::vector<SpeedInterval> doubtful; ///< motions could not be followed through: a narrow band
                                         ///< may lie there
};

/// Unstable spin speeds between the first and the last of `speeds`, ends refined as roots
/// (relative 1e-10), an end at the border of the range where instability reaches it. How bands
/// narrower than the grid are found: band_search.h. Growth that sinks below what rounding lets one
/// see without having been zero (balls near rest: a power of the speed) is carried on.
///
/// @param speeds  ascending, at least two
[[nodiscard]] BandsFound find_bands(const MotionsAt &at, const std::vector<double> &speeds);

/// Only the bands.
[[nodiscard]] std::vector<SpeedInterval> unstable_bands(const MotionsAt &at,
                                                        const std::vector<double> &speeds);

/// The end of instability between a stable and an unstable speed. Where the growth passes through
/// zero it is a root; where two eigenvalues part along the imaginary axis the growth starts like a
/// square root, and the speed at which it leaves the noise is the end to far less than 1e-10.
/// @param tolerance  width of the last bracket, rad/s
[[nodiscard]] double band_end(const MotionsAt &at, double stable, double unstable,
                              double tolerance);

/// Where to look next for the border between a stable and an unstable place: a secant between two
/// growths of known sign (0: not known), kept off the ends; every third step halves the bracket.
[[nodiscard]] double between_signs(double stable, double decline, double unstable, double growth,
                                   int step);

/// Where instability is strongest in a band found, rad/s.
[[nodiscard]] double strongest_speed(const MotionsAt &at, const SpeedInterval &band);

/// What both lists of bands have in common.
[[nodiscard]] std::vector<SpeedInterval> common(const std::vector<SpeedInterval> &a,
                                                const std::vector<SpeedInterval> &b);

/// Joins bands that touch or overlap; ascending.
[[nodiscard]] std::vector<SpeedInterval> joined(std::vector<SpeedInterval> bands);

} // namespace whirl::stability
