#pragma once

#include "stability/unstable_bands.h"

#include <optional>
#include <vector>

namespace whirl::stability {

class PeriodicMotions;

/// What the whole rotor makes of the bands of a reduced one: each end found again as a root, growth
/// inside of each band and none between them.
/// @param at        motions of the whole rotor
/// @param range     in which the bands were looked for
/// @param periodic  whose reduced rotor has the bands, its ends roots: those of the whole one are
///                  then found by Newton's method; or none
/// @returns nothing where the whole rotor does not agree; of a narrow band it can have none
[[nodiscard]] std::optional<std::vector<results::Interval>>
confirmed_bands(const MotionsAt &at, const std::vector<results::Interval> &bands,
                const results::Interval &range, const PeriodicMotions *periodic);

} // namespace whirl::stability
