#pragma once

#include "analyses/balance_result.h"
#include "model/case.h"

#include <string>
#include <vector>

namespace whirl::analyses {

/// Sentences that say what the bands mean and where flexible and rigid rotor differ, and why.
///
/// @param speeds  range of the bands
/// @param damped  the rotor on its bearings has damping
[[nodiscard]] std::vector<std::string>
balance_findings(const BalanceResult &result, const model::SpeedRange &speeds, bool damped);

} // namespace whirl::analyses
