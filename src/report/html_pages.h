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

/// The report page of a result. `picture`: the SVG shown where the page cannot be interactive.
[[nodiscard]] std::string to_html(const model::Case &scene, const results::CampbellResult &result,
                                  const std::string &picture);
[[nodiscard]] std::string to_html(const model::Case &scene, const results::CriticalResult &result,
                                  const std::string &picture);
[[nodiscard]] std::string to_html(const model::Case &scene, const results::ResponseResult &result,
                                  const std::string &picture);
[[nodiscard]] std::string to_html(const model::Case &scene, const results::ModesResult &result,
                                  const std::string &picture);
/// `more`: SVG of further pictures, shown after the scene.
[[nodiscard]] std::string to_html(const model::Case &scene, const results::ShowResult &result,
                                  const std::string &picture, const std::string &more = "");
[[nodiscard]] std::string to_html(const model::Case &scene, const results::AccuracyResult &result,
                                  const std::string &picture);
[[nodiscard]] std::string to_html(const model::Case &scene, const results::StabilityResult &result,
                                  const std::string &picture);
[[nodiscard]] std::string to_html(const model::Case &scene, const results::RigidLimitResult &result,
                                  const std::string &picture);
[[nodiscard]] std::string to_html(const model::Case &scene, const results::BalanceResult &result,
                                  const std::string &picture);

} // namespace whirl::report
