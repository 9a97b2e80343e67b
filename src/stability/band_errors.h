#pragma once

#include "stability/band_finder.h"
#include "stability/unstable_bands.h"

#include <functional>
#include <optional>
#include <vector>

namespace whirl::stability {

/// Error of the end at this speed, rad/s, where it is known as a root; nothing elsewhere.
/// @param inward  1 where the band lies above it, -1 below
/// @param reach   rad/s, how far the finer model's can lie
using ErrorByRoot = std::function<std::optional<double>(double speed, double inward, double reach)>;

/// Error of both ends of each band, rad/s: the distance to the end that a finer model has there
/// (order p + 4 on the same mesh), and what rounding leaves open of the place where the growth
/// passes through zero. An end at the border of the range has none; a band that the finer model
/// does not have is off by its width.
///
/// @param finder  of the model that the bands belong to
/// @param range   in which they were looked for
/// @param by_root  asked first
[[nodiscard]] std::vector<results::EndErrors>
band_errors(const BandFinder &finder, const std::vector<results::Interval> &bands,
            const results::Interval &range, const ErrorByRoot &by_root);

} // namespace whirl::stability
