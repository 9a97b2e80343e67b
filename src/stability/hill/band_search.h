#pragma once

#include "stability/hill/coalescence.h"
#include "stability/unstable_bands.h"

#include <array>
#include <complex>
#include <map>
#include <utility>
#include <vector>

namespace whirl::stability {

/// Looks through a range of spin speeds for instability, however narrow.
///
/// Every motion is followed from one speed to the next (coalescence.h). A step in which that fails
/// is halved until it does not, so that the answer does not depend on the grid; what is left when a
/// step has become minute is doubtful. In a step that is understood instability can begin and end
///  - where a motion grows at one end of it,
///  - where two motions meet in frequency (pair_search.h),
///  - at a peak of a motion's real part between speeds at which it decays,
/// and a stable window lies in it where no motion grows at both ends of it or the largest growth
/// has a dip.
class BandSearch {
  public:
    /// @param speeds  ascending, at least two
    BandSearch(const MotionsAt &at, const std::vector<double> &speeds);

    /// All speeds looked at; stable windows found in between count as decay.
    [[nodiscard]] const Known &known() const { return _known; }
    /// Unstable speeds, each with a first step to look for the ends of its band.
    [[nodiscard]] const std::vector<std::pair<double, double>> &seeds() const { return _seeds; }
    [[nodiscard]] const std::vector<results::Interval> &doubtful() const { return _doubtful; }

  private:
    /// Motions at a speed.
    struct Probe {
        double speed = 0;
        std::vector<Motion> motions;
        double growth = 0;
    };

    const MotionsAt &_at;
    Known _known;
    std::vector<std::pair<double, double>> _seeds;
    std::vector<results::Interval> _doubtful;
    int _halvings = 0; ///< so far
    int _most_halvings;

    std::map<double, Probe> _probes;                              ///< all so far
    std::map<std::pair<double, double>, Continuation> _continued; ///< between neighbours

    [[nodiscard]] const Probe &probe(double speed, double step);
    [[nodiscard]] const Continuation &continuation(const Probe &a, const Probe &b);
    void add_beyond(Coalescence &m, const Probe &end, std::array<int, 2> at,
                    std::complex<double> first, std::complex<double> second, bool upwards);
    void through(const Probe &a, const Probe &b, int depth);
    void halve(const Probe &a, const Probe &b, int depth);
    [[nodiscard]] bool coalescences_resolved(const Continuation &next, const Probe &a,
                                             const Probe &b);
    [[nodiscard]] static bool one_grows_through(const Continuation &next, const Probe &a,
                                                const Probe &b);
    void window_between(double from, double to);
    void peaks(const Probe &a, const Probe &b, const Probe &c);
    void peak_of(const std::array<double, 3> &speeds,
                 const std::array<std::complex<double>, 3> &values);
    void dip(const Probe &a, const Probe &b, const Probe &c);
};

} // namespace whirl::stability
