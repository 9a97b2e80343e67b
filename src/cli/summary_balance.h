#pragma once

#include "results/balance.h"

#include <string>

namespace whirl::cli {

/// Bands, findings, placement and pendulums for the terminal.
[[nodiscard]] std::string balance_text(const results::BalanceResult &result);

} // namespace whirl::cli
