#pragma once

#include "analyses/results.h"
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

} // namespace whirl::cli
