#pragma once

#include "model/rotor.h"
#include "report/common/units.h"

#include <string>
#include <vector>

namespace whirl::report {

/// Outer radius at z, m; where two segments meet, the larger one.
[[nodiscard]] double shaft_radius(const model::Shaft &shaft, double z);

// Shapes over the outline of the rotor, for gnuplot.

/// Data blocks $outline, boxes (z, radius) of shaft and discs, and $bearings, below them.
/// @param largest  largest deflection of the shape that goes with it: the thickest part of the
///                 outline has half that radius
[[nodiscard]] std::string outline_data(const Units &units, const model::Rotor &rotor,
                                       double largest);
/// An empty plot with the legend of such panels at a height of the screen.
[[nodiscard]] std::string curve_legend(double height);
/// The plot command of a panel: deflections x and y along z, m, within their envelope.
/// @param factor  of the deflections
[[nodiscard]] std::string curves_over_outline(const Units &units, const std::vector<double> &z,
                                              const std::vector<double> &x,
                                              const std::vector<double> &y,
                                              const std::vector<double> &envelope, double factor);

} // namespace whirl::report
