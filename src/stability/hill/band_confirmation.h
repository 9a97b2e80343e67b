#pragma once

#include "stability/unstable_bands.h"

#include <optional>
#include <vector>

namespace whirl::stability {

class PeriodicMotions;

/// Verifies bands of the reduced rotor on the whole one: each end is found again as a root, with
/// growth inside each band and none between them.
/// @param at        motions of the whole rotor
/// @param range     in which the bands were looked for
/// @param periodic  whose reduced rotor has the bands, its ends roots: those of the whole one are
///                  then found by Newton's method; or none
/// @returns nothing where the whole rotor does not agree; of a narrow band it can have none
[[nodiscard]] std::optional<std::vector<results::Interval>>
confirmed_bands(const MotionsAt &at, const std::vector<results::Interval> &bands,
                const results::Interval &range, const PeriodicMotions *periodic);

} // namespace whirl::stability
