#pragma once

#include "model/bearing.h"

namespace whirl::input {

using CoefficientMatrix = Eigen::Matrix2d model::BearingCoefficients::*;

/// Rows of the cubic spline (not-a-knot) through the rows of a table, so near that straight lines
/// between them depart from the spline by at most 1e-5 of the largest entry of that kind.
/// Between two rows of the table there is a line, among three a parabola.
/// @returns false where that would take more than 2000 rows
[[nodiscard]] bool refine_by_spline(model::Bearing &bearing);

} // namespace whirl::input
