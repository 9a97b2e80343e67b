#pragma once

#include "results/interval.h"
#include "stability/hill/motions.h"

#include <cmath>
#include <functional>
#include <map>
#include <vector>

namespace whirl::stability {

using MotionsAt = std::function<std::vector<Motion>(double speed)>;

/// Growth at speeds looked at, ascending: above zero unstable, below stable, zero not decided.
using Known = std::map<double, double>;

struct BandsFound {
    std::vector<results::Interval> bands;    ///< ascending, apart
    std::vector<results::Interval> doubtful; ///< motions could not be followed through: a narrow
                                             ///< band may lie there
};

/// Unstable spin speeds between the first and the last of `speeds`, ends refined as roots
/// (relative 1e-10), an end at the border of the range where instability reaches it. How bands
/// narrower than the grid are found: band_search.h. Growth that sinks below what rounding lets one
/// see without having been zero (balls near rest: a power of the speed) is carried on.
///
/// @param speeds  ascending, at least two
/// @param part    ends to that part of a band, where they need not be known better
[[nodiscard]] BandsFound find_bands(const MotionsAt &at, const std::vector<double> &speeds,
                                    double part = 0);

/// The band around a speed at which something grows, between two borders, searched outwards.
/// @param step  the first one, rad/s
[[nodiscard]] results::Interval band_around(const MotionsAt &at, double unstable, double step,
                                            const results::Interval &borders);

/// Only the bands.
[[nodiscard]] std::vector<results::Interval> unstable_bands(const MotionsAt &at,
                                                            const std::vector<double> &speeds);

/// The end of instability between a stable and an unstable speed. Where the growth passes through
/// zero it is a root; where two eigenvalues part along the imaginary axis the growth starts like a
/// square root: its square goes on as minus that of half their distance on the axis, and the speed
/// at which it leaves the noise is the end to far less than 1e-10.
/// @param tolerance  width of the last bracket, rad/s
[[nodiscard]] double band_end(const MotionsAt &at, double stable, double unstable,
                              double tolerance);

/// The border between a stable and an unstable place, by speeds in between: secants between two
/// growths of known sign, kept off the ends, of which one that stays is weighted less each time
/// (Anderson and Björck); halves where a sign is not known or secants do not get on.
class SignBracket {
  public:
    SignBracket(double stable, double unstable) : _stable(stable), _unstable(unstable) {}

    /// The next speed to try.
    [[nodiscard]] double next();
    /// @param growth  there, not above zero; 0: not known whether it is below
    void stable_at(double place, double growth);
    /// @param growth  there, above zero
    void unstable_at(double place, double growth);

    /// From here on both growths are squares of half the difference of two motions, which has a
    /// root where they meet: negative while they differ in frequency alone.
    void square_growth() {
        _growth *= _growth;
        _decline = 0;
    }

    [[nodiscard]] double stable() const { return _stable; }
    [[nodiscard]] double unstable() const { return _unstable; }
    [[nodiscard]] double width() const { return std::abs(_unstable - _stable); }
    /// Growth dies out at the stable end.
    [[nodiscard]] bool decays() const { return _decline < 0; }

  private:
    double _stable, _unstable;
    double _decline = 0; ///< at the stable end; 0: not known
    double _growth = 0;  ///< at the unstable end; 0: not known
    int _last = 0;       ///< the end that moved last: -1 the stable one, 1 the other
    int _steps = 0;      ///< since the bracket was half as wide again
    double _wide = HUGE_VAL;
};

/// That border, to a width.
/// @param growth    over the place; where it is 0 beside places at which it is below zero, the root
/// @param unstable  where it is above zero
/// @returns the stable end
[[nodiscard]] double border_of_growth(const std::function<double(double place)> &growth,
                                      double stable, double unstable, double width);

/// Where instability is strongest in a band found, rad/s.
/// @param growth  over the speed, 1/s
[[nodiscard]] double strongest_speed(const std::function<double(double speed)> &growth,
                                     const results::Interval &band);

/// The intersection of two lists of bands.
[[nodiscard]] std::vector<results::Interval> common(const std::vector<results::Interval> &a,
                                                    const std::vector<results::Interval> &b);

/// Joins bands that touch or overlap; ascending.
[[nodiscard]] std::vector<results::Interval> joined(std::vector<results::Interval> bands);

} // namespace whirl::stability
