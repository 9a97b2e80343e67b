#pragma once

#include "report/common/json.h"

#include <string>

namespace whirl::report {

/// That a result from a file holds what a comparison reads, lists that belong together with as many
/// entries each.
/// @param name  of the file, for messages: `before.json: critical_speeds[2].speed: expected a
///              number, got "12"`
/// @throws model::BadInput at the first place where it does not
void check_result(const Json &json, const std::string &name);

} // namespace whirl::report
