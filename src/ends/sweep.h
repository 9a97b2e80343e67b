#pragma once

#include "ends/all_motions.h"
#include "stability/unstable_bands.h"

#include <complex>
#include <map>
#include <vector>

namespace whirl::ends {

/// A speed at which a motion begins or ceases to grow, placed by the cubic over its step.
struct Change {
    double speed = 0;           ///< rad/s
    double from = 0, to = 0;    ///< the step that it lies in
    std::complex<double> value; ///< l there, Im >= 0
    int gain = 0;               ///< 1 begins to grow, -1 ceases, as the speed rises
    bool smooth = true;         ///< false: motions meet there, found by halving alone
    bool undamped = false;      ///< they did neither grow nor die out before they met
};

/// How many motions grow at a speed, and of how many of those that are not too fast rounding hides
/// whether they do.
struct Count {
    int growing = 0;
    int unknown = 0;
    int hidden = 0;   ///< the same of fast ones that can grow (AllMotions::hides_growth)
    int resolved = 0; ///< growing ones that the mesh resolves
};

/// What a range of speeds shows.
struct Swept {
    std::vector<Change> changes;
    std::map<double, Count> counts;            ///< at all speeds looked at
    std::vector<results::Interval> doubtful{}; ///< steps in which motions were not followed
};

/// Follows all eigenvalues of a rotor through a range of speeds, with steps that are halved until
/// what values and rates at both ends say of the real parts in between can be trusted, so that
/// nothing depends on the steps one begins with: a motion that grows for a part of a step is seen,
/// whatever the others do.
/// @param piece   of the range between table rows
/// @param speeds  in it, ascending, to begin with
[[nodiscard]] Swept swept(const AllMotions &motions, int piece, const std::vector<double> &speeds);

} // namespace whirl::ends
