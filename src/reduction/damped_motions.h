#pragma once

#include "reduction/reduced_rotor.h"

#include <Eigen/Core>

namespace whirl::reduction {

/// Eigenvalues of the free motions exp(lambda t) of a reduced rotor on its supports, with all its
/// damping, in axes that stand still, 1/s; 4r of them.
/// @param speed  rad/s, of the spin, > 0
[[nodiscard]] Eigen::VectorXcd damped_eigenvalues(const ReducedRotor &rotor, double speed);

} // namespace whirl::reduction
