#pragma once

#include "model/case.h"
#include "report/pictures/style.h"

#include <string>

namespace whirl::report {

/// Which axis of a panel has the spin speed.
enum class SpeedAxis { x, y };

/// The operating speeds of the case behind the curves of the next plot: a light band, and a line at
/// the trip speed. Nothing where the case names none or they lie outside the axis. The commands
/// last until `unset object` and `unset arrow`.
/// @param range  of the axis, in the unit of speeds
[[nodiscard]] std::string operation_band(const model::Case &scene, const Units &units, Range range,
                                         SpeedAxis axis = SpeedAxis::x);

/// Both ends of the band as lines, for what lies over it. Commands as above.
/// @param range  of the axis x
[[nodiscard]] std::string operation_edges(const model::Case &scene, const Units &units,
                                          Range range);

/// The same over a picture that fills its panel: lines at both ends and at the trip speed.
[[nodiscard]] std::string operation_lines(const model::Case &scene, const Units &units, Range range,
                                          SpeedAxis axis);

/// Entries of a legend for what operation_band draws, or nothing.
[[nodiscard]] std::string operation_key(const model::Case &scene, const Units &units, Range range);

} // namespace whirl::report
