#pragma once

#include "model/case.h"
#include "report/pictures/chart.h"

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

/// Ends of the band and the trip speed as lines, over what covers it: across each axis of the panel
/// that has the spin speed.
void add_operation(const model::Case &scene, const Units &units, const LineStyle &style,
                   ChartPanel &panel);

/// Entries of a legend for what operation_band draws, or nothing.
[[nodiscard]] std::string operation_key(const model::Case &scene, const Units &units, Range range);

} // namespace whirl::report
