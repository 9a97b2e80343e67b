#pragma once

#include "analyses/balance_result.h"
#include "analyses/response_result.h"
#include "analyses/results.h"
#include "analyses/rigid_limit_result.h"
#include "analyses/stability_result.h"
#include "model/case.h"

#include <string>

namespace whirl::report {

/// The result as JSON (keys: docs/case_format.md, "Results"): SI and radians, numbers with all
/// digits, null for what is missing or not finite.
[[nodiscard]] std::string to_json(const model::Case &scene, const analyses::CampbellResult &result);
[[nodiscard]] std::string to_json(const model::Case &scene, const analyses::CriticalResult &result);
[[nodiscard]] std::string to_json(const model::Case &scene, const analyses::ResponseResult &result);
[[nodiscard]] std::string to_json(const model::Case &scene, const analyses::ModesResult &result);
[[nodiscard]] std::string to_json(const model::Case &scene, const analyses::ShowResult &result);
[[nodiscard]] std::string to_json(const model::Case &scene, const analyses::AccuracyResult &result);
[[nodiscard]] std::string to_json(const model::Case &scene,
                                  const analyses::StabilityResult &result);
[[nodiscard]] std::string to_json(const model::Case &scene,
                                  const analyses::RigidLimitResult &result);
[[nodiscard]] std::string to_json(const model::Case &scene, const analyses::BalanceResult &result);

/// Version of the program, as in the results.
[[nodiscard]] std::string program_version();

} // namespace whirl::report
