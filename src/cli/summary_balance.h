#pragma once

#include "analyses/balance_result.h"

#include <string>

namespace whirl::cli {

/// Bands, findings, placement and pendulums for the terminal.
[[nodiscard]] std::string balance_text(const analyses::BalanceResult &result);

} // namespace whirl::cli
