#pragma once

#include "report/common/json.h"

namespace whirl::report {

/// A result in the units that were asked for, by the keys of its numbers. `units` says of each key
/// that was converted what its unit is; all others are in SI.
void convert_json(Json &json);

} // namespace whirl::report
