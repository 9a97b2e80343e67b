#pragma once

#include "model/case.h"
#include "results/balance.h"

#include <optional>
#include <string>
#include <vector>

namespace whirl::analyses {

/// Where every motion about the balanced position dies out, with the real balancers in all their
/// planes: what unstable_bands.h leaves of the range. None without balancers, without a range of
/// speeds or without a balanced position, which a note explains.
[[nodiscard]] std::optional<results::BalancedPosition>
balanced_position(const model::Case &scene, std::vector<std::string> &notes);

} // namespace whirl::analyses
