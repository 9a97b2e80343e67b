#pragma once

#include "model/rotor.h"
#include "report/common/units.h"
#include "report/pictures/chart.h"

#include <vector>

namespace whirl::report {

/// Outer radius at z, m; where two segments meet, the larger one.
[[nodiscard]] double shaft_radius(const model::Shaft &shaft, double z);

/// Marks of the bearings, below an outline of this size.
[[nodiscard]] ChartCurve bearings_below(const Units &units, const model::Rotor &rotor,
                                        const std::string &name, double size);
/// Shaft and discs as areas, bearings below them; the thickest part has half of a size as radius.
[[nodiscard]] std::vector<ChartCurve> rotor_outline(const Units &units, const model::Rotor &rotor,
                                                    double size);

/// Deflections x and y along z, m, within their envelope, over the outline of the rotor.
/// @param factor   of the deflections
/// @param largest  times the factor: the thickest part of the outline has half that radius
[[nodiscard]] std::vector<ChartCurve>
curves_over_outline(const Units &units, const model::Rotor &rotor, const std::vector<double> &z,
                    const std::vector<double> &x, const std::vector<double> &y,
                    const std::vector<double> &envelope, double factor, double largest);
/// The axis of z that goes with it.
[[nodiscard]] ChartAxis along_shaft(const Units &units, const model::Rotor &rotor);

} // namespace whirl::report
