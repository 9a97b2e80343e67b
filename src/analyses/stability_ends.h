#pragma once

#include "ends/all_motions.h"
#include "results/stability.h"
#include "stability/unstable_bands.h"

#include <vector>

namespace whirl::analyses {

/// Largest real part and verdict at the speeds of the result, of all motions of the rotor.
void add_growth(const ends::AllMotions &motions, results::StabilityResult &result);

/// Speeds at which the number of growing motions changes, beside the bands of the result, which
/// they complete; notes where the two cannot be made to agree.
/// @param motions  of the rotor; none: form hill
/// @param at       motions at a speed, for the bands
/// @param grid     speeds at which bands were looked for
void add_ends(const ends::AllMotions *motions, results::Form form, const stability::MotionsAt &at,
              const std::vector<double> &grid, results::StabilityResult &result);

} // namespace whirl::analyses
