#pragma once

#include "ends/all_motions.h"
#include "results/stability.h"
#include "stability/unstable_bands.h"

#include <vector>

namespace whirl::ends {

/// Steps of a range to begin with; they are halved where that is needed.
constexpr int usual_steps = 24;
/// The same for one of many rotors that hardly differ.
constexpr int few_steps = 8;

struct EndsFound {
    std::vector<results::StabilityEnd> ends; ///< ascending
    int growing_from = 0;                    ///< motions that grow at the beginning of the range
    /// Where the number of growing motions does not follow from the ends.
    std::vector<results::Interval> doubtful;
    /// The motions on the imaginary axis at the ends that were found on the whole rotor.
    std::vector<EndOfGrowth> roots;
};

/// Every speed of the range at which the number of growing motions changes. All eigenvalues of the
/// reduced rotor are followed through the range (sweep.h); each change is found again with the
/// whole rotor, as a root (refinement.h), relative 1e-12 but for rounding.
/// @param steps  to begin with
[[nodiscard]] EndsFound find_ends(const AllMotions &motions, int steps = usual_steps);

} // namespace whirl::ends
