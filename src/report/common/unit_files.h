#pragma once

#include "report/common/json.h"

#include <string>

namespace whirl::report {

/// A table in a file in the units that were asked for, by those in brackets at the end of its
/// headings: "amplitude [m]" to "pk-pk amplitude [um]" or the like.
[[nodiscard]] std::string csv_in_written_units(const std::string &csv);

/// A result in them, by the keys of its numbers. `units` says of each key that was converted what
/// its unit is; all others are in SI.
void convert_json(Json &json);

} // namespace whirl::report
