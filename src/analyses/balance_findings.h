#pragma once

#include "model/case.h"
#include "results/balance.h"

#include <string>
#include <vector>

namespace whirl::analyses {

/// Sentences that say what the bands mean and where flexible and rigid rotor, and the three tiers,
/// differ, and why. None for one speed alone.
[[nodiscard]] std::vector<std::string> balance_findings(const results::BalanceResult &result,
                                                        const model::Case &scene);

} // namespace whirl::analyses
