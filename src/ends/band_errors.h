#pragma once

#include "ends/refinement.h"
#include "results/interval.h"
#include "stability/band_finder.h"

#include <vector>

namespace whirl::ends {

/// Error of both ends of each band, rad/s: the distance to the end that a finer model has there
/// (order p + 4 on the same mesh), and what rounding leaves open of the place where the growth
/// passes through zero. An end at the border of the range has none; a band that the finer model
/// does not have is off by its width. By a root of the finer model where the end is known as one,
/// else by its growth.
///
/// @param finder  of the model that the bands belong to
/// @param range   in which they were looked for
/// @param roots   the motions at ends that are known as roots
[[nodiscard]] std::vector<results::EndErrors>
band_errors(const stability::BandFinder &finder, const std::vector<results::Interval> &bands,
            const results::Interval &range, const std::vector<EndOfGrowth> &roots);

} // namespace whirl::ends
