#pragma once

#include <Eigen/Core>

namespace whirl::model {

/// Coefficients on (x, y) with the symmetry that they have but for rounding, as after a turn of the
/// axes (bearing.h): what couples the axes against it feeds or drains energy, however small.
[[nodiscard]] Eigen::Matrix2d without_rounding(const Eigen::Matrix2d &a);

} // namespace whirl::model
