#pragma once

#include "analyses/balance_result.h"
#include "analyses/response_result.h"
#include "analyses/results.h"
#include "analyses/rigid_limit_result.h"
#include "analyses/stability_result.h"
#include "model/case.h"

#include <string>

namespace whirl::cli {

/// The result as text for a terminal: title, the main table, notes, and the model behind it.
[[nodiscard]] std::string summary(const model::Case &scene, const analyses::CampbellResult &result);
[[nodiscard]] std::string summary(const model::Case &scene, const analyses::CriticalResult &result);
[[nodiscard]] std::string summary(const model::Case &scene, const analyses::ResponseResult &result);
[[nodiscard]] std::string summary(const model::Case &scene, const analyses::ModesResult &result);
[[nodiscard]] std::string summary(const model::Case &scene, const analyses::ShowResult &result);
[[nodiscard]] std::string summary(const model::Case &scene, const analyses::AccuracyResult &result);
[[nodiscard]] std::string summary(const model::Case &scene,
                                  const analyses::StabilityResult &result);
[[nodiscard]] std::string summary(const model::Case &scene,
                                  const analyses::RigidLimitResult &result);
[[nodiscard]] std::string summary(const model::Case &scene, const analyses::BalanceResult &result);

} // namespace whirl::cli
