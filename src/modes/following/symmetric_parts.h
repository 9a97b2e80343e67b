#pragma once

#include "assembly/discretization.h"

#include <Eigen/SparseCore>

#include <vector>

namespace whirl::modes {

// Real symmetric matrices of a SymmetricProblem, in the order of its parts;
// bearings as at a speed (rad/s).

[[nodiscard]] std::vector<Eigen::SparseMatrix<double>>
planar_parts(const assembly::Discretization &d, double bearing_speed);

/// In p = (x + y') / sqrt(2) and q = (x - y') / sqrt(2) with y = i y'; none where the general form
/// is not symmetric so.
[[nodiscard]] std::vector<Eigen::SparseMatrix<double>>
general_parts(const assembly::Discretization &d, double bearing_speed);

} // namespace whirl::modes
