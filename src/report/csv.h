#pragma once

#include "results/accuracy.h"
#include "results/balance.h"
#include "results/campbell.h"
#include "results/critical.h"
#include "results/modes.h"
#include "results/response.h"
#include "results/rigid_limit.h"
#include "results/show.h"
#include "results/stability.h"

#include <string>

namespace whirl::report {

/// The result as one tidy table: a header with units in brackets, one observation a row, numbers
/// with all digits, an empty cell for what is missing or not finite.
[[nodiscard]] std::string to_csv(const results::CampbellResult &result);
[[nodiscard]] std::string to_csv(const results::CriticalResult &result);
[[nodiscard]] std::string to_csv(const results::ResponseResult &result);
[[nodiscard]] std::string to_csv(const results::ModesResult &result);
[[nodiscard]] std::string to_csv(const results::ShowResult &result);
[[nodiscard]] std::string to_csv(const results::AccuracyResult &result);
[[nodiscard]] std::string to_csv(const results::StabilityResult &result);
[[nodiscard]] std::string to_csv(const results::RigidLimitResult &result);
[[nodiscard]] std::string to_csv(const results::BalanceResult &result);

} // namespace whirl::report
