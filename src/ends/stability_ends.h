#pragma once

#include "ends/all_motions.h"
#include "results/stability.h"

#include <utility>
#include <vector>

namespace whirl::ends {

using SpeedInterval = std::pair<double, double>; ///< rad/s

struct EndsFound {
    std::vector<results::StabilityEnd> ends; ///< ascending
    /// Where the number of growing motions is not what the ends make of it.
    std::vector<SpeedInterval> doubtful;
};

/// Every speed between two at which the number of growing motions changes. All eigenvalues of the
/// reduced rotor are followed through the range (sweep.h); each change is found again with the
/// whole rotor, as a root (refinement.h), relative 1e-12 but for rounding.
/// @param looks  speeds that should be looked at, as inside of bands known already
[[nodiscard]] EndsFound find_ends(const AllMotions &motions, double from, double to,
                                  const std::vector<double> &looks);

/// Makes the ends and the unstable bands tell one story: what grows for one grows for the other.
/// An end at which growth begins or ceases altogether is the band's end, to the last digit; bands
/// that were not known are taken up, and ends that were not.
void reconcile(std::vector<results::StabilityEnd> &ends, std::vector<SpeedInterval> &bands,
               double from, double to);

} // namespace whirl::ends
