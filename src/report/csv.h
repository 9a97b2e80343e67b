#pragma once

#include "analyses/balance_result.h"
#include "analyses/response_result.h"
#include "analyses/results.h"
#include "analyses/rigid_limit_result.h"
#include "analyses/stability_result.h"

#include <string>

namespace whirl::report {

/// The result as one tidy table: a header with units in brackets, one observation a row, numbers
/// with all digits, an empty cell for what is missing or not finite.
[[nodiscard]] std::string to_csv(const analyses::CampbellResult &result);
[[nodiscard]] std::string to_csv(const analyses::CriticalResult &result);
[[nodiscard]] std::string to_csv(const analyses::ResponseResult &result);
[[nodiscard]] std::string to_csv(const analyses::ModesResult &result);
[[nodiscard]] std::string to_csv(const analyses::ShowResult &result);
[[nodiscard]] std::string to_csv(const analyses::AccuracyResult &result);
[[nodiscard]] std::string to_csv(const analyses::StabilityResult &result);
[[nodiscard]] std::string to_csv(const analyses::RigidLimitResult &result);
[[nodiscard]] std::string to_csv(const analyses::BalanceResult &result);

} // namespace whirl::report
