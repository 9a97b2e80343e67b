#pragma once

#include "analyses/balance_result.h"
#include "analyses/response_result.h"
#include "analyses/results.h"
#include "analyses/rigid_limit_result.h"
#include "analyses/stability_result.h"
#include "model/case.h"

#include <string>

namespace whirl::report {

/// The report page of a result. `picture`: the SVG shown where the page cannot be interactive.
[[nodiscard]] std::string to_html(const model::Case &scene, const analyses::CampbellResult &result,
                                  const std::string &picture);
[[nodiscard]] std::string to_html(const model::Case &scene, const analyses::CriticalResult &result,
                                  const std::string &picture);
[[nodiscard]] std::string to_html(const model::Case &scene, const analyses::ResponseResult &result,
                                  const std::string &picture);
[[nodiscard]] std::string to_html(const model::Case &scene, const analyses::ModesResult &result,
                                  const std::string &picture);
/// `more`: SVG of further pictures, shown after the scene.
[[nodiscard]] std::string to_html(const model::Case &scene, const analyses::ShowResult &result,
                                  const std::string &picture, const std::string &more = "");
[[nodiscard]] std::string to_html(const model::Case &scene, const analyses::AccuracyResult &result,
                                  const std::string &picture);
[[nodiscard]] std::string to_html(const model::Case &scene, const analyses::StabilityResult &result,
                                  const std::string &picture);
[[nodiscard]] std::string to_html(const model::Case &scene,
                                  const analyses::RigidLimitResult &result,
                                  const std::string &picture);
[[nodiscard]] std::string to_html(const model::Case &scene, const analyses::BalanceResult &result,
                                  const std::string &picture);

} // namespace whirl::report
