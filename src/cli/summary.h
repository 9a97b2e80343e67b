#pragma once

#include "model/case.h"
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

namespace whirl::cli {

/// The result as text for a terminal: title, the main table, notes, and the model behind it.
[[nodiscard]] std::string summary(const model::Case &scene, const results::CampbellResult &result);
[[nodiscard]] std::string summary(const model::Case &scene, const results::CriticalResult &result);
[[nodiscard]] std::string summary(const model::Case &scene, const results::ResponseResult &result);
[[nodiscard]] std::string summary(const model::Case &scene, const results::ModesResult &result);
[[nodiscard]] std::string summary(const model::Case &scene, const results::ShowResult &result);
[[nodiscard]] std::string summary(const model::Case &scene, const results::AccuracyResult &result);
[[nodiscard]] std::string summary(const model::Case &scene, const results::StabilityResult &result);
[[nodiscard]] std::string summary(const model::Case &scene,
                                  const results::RigidLimitResult &result);
[[nodiscard]] std::string summary(const model::Case &scene, const results::BalanceResult &result);

} // namespace whirl::cli
