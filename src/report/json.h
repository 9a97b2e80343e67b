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

namespace whirl::report {

/// The result as JSON (keys: docs/case_format.md, "Results"): SI and radians, numbers with all
/// digits, null for what is missing or not finite.
[[nodiscard]] std::string to_json(const model::Case &scene, const results::CampbellResult &result);
[[nodiscard]] std::string to_json(const model::Case &scene, const results::CriticalResult &result);
[[nodiscard]] std::string to_json(const model::Case &scene, const results::ResponseResult &result);
[[nodiscard]] std::string to_json(const model::Case &scene, const results::ModesResult &result);
[[nodiscard]] std::string to_json(const model::Case &scene, const results::ShowResult &result);
[[nodiscard]] std::string to_json(const model::Case &scene, const results::AccuracyResult &result);
[[nodiscard]] std::string to_json(const model::Case &scene, const results::StabilityResult &result);
[[nodiscard]] std::string to_json(const model::Case &scene,
                                  const results::RigidLimitResult &result);
[[nodiscard]] std::string to_json(const model::Case &scene, const results::BalanceResult &result);

/// Version of the program, as in the results.
[[nodiscard]] std::string program_version();

} // namespace whirl::report
