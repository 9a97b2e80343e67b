#pragma once

#include "assembly/discretization.h"
#include "balancers/linear_element.h"
#include "periodic/whole_root.h"

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace whirl::modes {

/// Planar shapes, N x r, with which the slowest modes of a rotor of form hill
/// (hill/floquet_spectrum.h) are nearly those of the whole one over a range of speeds: at six of
/// them to 1e-6 of the speed or the eigenvalue, 1e-5 where motions die out far within half a turn.
/// @param balancers  at their balanced positions
/// @param whole      the same with all unknowns
/// @param from,to    rad/s
/// @param wanted     modes at each speed
/// @returns none where hardly fewer shapes than unknowns do
/// @throws linalg::SolverError where modes are not found
[[nodiscard]] std::shared_ptr<const Eigen::MatrixXd>
floquet_shapes(const assembly::Discretization &discretization,
               const std::vector<balancers::BalancerElement> &balancers,
               const periodic::WholeRotor &whole, double from, double to, int wanted);

} // namespace whirl::modes
