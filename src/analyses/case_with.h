#pragma once

#include "model/case.h"

#include <functional>
#include <string>
#include <vector>

namespace whirl::analyses {

/// The case with entries overridden: "path.to.key=value". @throws model::BadInput
using CaseWith = std::function<model::Case(const std::vector<std::string> &overrides)>;

} // namespace whirl::analyses
