#pragma once

#include "assembly/discretization.h"

#include <Eigen/SparseCore>

#include <vector>

namespace whirl::modes {

/// Damping of the supports in one plane at a spin speed (rad/s), over the planar unknowns, N s/m;
/// entries at one place add up. That of the shaft does not act in circular whirl.
[[nodiscard]] std::vector<Eigen::Triplet<double>>
planar_support_damping(const assembly::Discretization &discretization, double speed);

} // namespace whirl::modes
