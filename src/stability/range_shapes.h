#pragma once

#include "assembly/discretization.h"
#include "balancers/arrangement.h"
#include "results/formulation.h"

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace whirl::stability {

/// Reduction basis that reproduces the slow motions of the whole rotor over a range of speeds: the
/// lowest modes at rest with static deflections (reduction::PlanarShapes), and of each motion at
/// some of the speeds that the whole rotor has elsewhere its own shapes. Forms general and
/// rotating.
/// @param speeds  ascending, at which the motions are compared
/// @param start   shapes of a rotor of this mesh that hardly differs, to begin with; or none
/// @returns nothing where a motion of the whole rotor is not found, or hardly fewer do
[[nodiscard]] std::shared_ptr<const Eigen::MatrixXd>
range_shapes(const assembly::Discretization &discretization, results::Form form,
             const balancers::Arrangement &arrangement, const std::vector<double> &speeds,
             const Eigen::MatrixXd *start = nullptr);

} // namespace whirl::stability
