#pragma once

#include "analyses/balance_result.h"
#include "model/case.h"

#include <string>
#include <vector>

namespace whirl::analyses {

/// Sentences that say what the bands mean and where flexible and rigid rotor, and the three tiers,
/// differ, and why. None for one speed alone.
[[nodiscard]] std::vector<std::string> balance_findings(const BalanceResult &result,
                                                        const model::Case &scene);

} // namespace whirl::analyses
