#pragma once

#include "results/balance.h"

#include <nlohmann/json_fwd.hpp>

namespace whirl::report {

/// The entries of the result of balance, without the common head.
[[nodiscard]] nlohmann::ordered_json balance_json(const results::BalanceResult &result);

} // namespace whirl::report
