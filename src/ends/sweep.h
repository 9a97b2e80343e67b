#pragma once

#include "ends/spectrum.h"
#include "ends/strands.h"

#include <functional>
#include <map>
#include <utility>
#include <vector>

namespace whirl::ends {

using SpectrumAt = std::function<Spectrum(double speed)>;
/// Whether motions of this |l|, 1/s, are slow enough to be known to grow or not.
using SlowEnough = std::function<bool(double size)>;

/// A speed at which a motion begins or ceases to grow, as cubics between looks place it.
struct Change {
    double speed = 0;           ///< rad/s
    double from = 0, to = 0;    ///< the step that it lies in
    std::complex<double> value; ///< l there, Im >= 0
    int gain = 0;               ///< 1 begins to grow, -1 ceases, as the speed rises
    bool smooth = true;         ///< false: motions meet there, found by halving alone
    bool undamped = false;      ///< they did neither grow nor die out before they met
};

/// How many motions grow at a speed, and of how many of those that are not too fast rounding does
/// not let one tell.
struct Count {
    int growing = 0;
    int unknown = 0;
    int resolved = 0; ///< growing ones that the mesh resolves
};

/// Follows all eigenvalues of a rotor through a range of speeds, with steps that are halved until
/// what values and rates at both ends say of the real parts in between can be trusted, so that
/// nothing depends on the steps one begins with: a motion that grows for a part of a step is seen,
/// whatever the others do.
class Sweep {
  public:
    /// @param speeds  ascending, to begin with
    /// @param resolved  |l| up to which motions are counted as resolved, 1/s
    Sweep(const SpectrumAt &at, const std::vector<double> &speeds, SlowEnough slow,
          double resolved);

    [[nodiscard]] const std::vector<Change> &changes() const { return _changes; }
    /// At all speeds looked at.
    [[nodiscard]] const std::map<double, Count> &counts() const { return _counts; }
    /// Steps in which motions could not be followed.
    [[nodiscard]] const std::vector<std::pair<double, double>> &doubtful() const {
        return _doubtful;
    }

  private:
    const SpectrumAt &_at;
    std::vector<Change> _changes;
    std::map<double, Count> _counts;
    std::vector<std::pair<double, double>> _doubtful;
    double _scale = 0; ///< largest speed, rad/s
    SlowEnough _slow;
    double _resolved;
    int _looks_left;

    [[nodiscard]] Spectrum look(double speed);
    void through(const Spectrum &a, const Spectrum &b);
    [[nodiscard]] std::optional<double> take(const Spectrum &a, const Spectrum &b,
                                             const Strands &strands);
    void take_abrupt(const Spectrum &a, const Spectrum &b);
};

} // namespace whirl::ends
