#pragma once

#include "stability/motions.h"

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace whirl::stability {

/// Those of some eigenpairs that none of the others is, as far as a search for bands needs them:
/// 1e-7 of the spin speed.
/// @param repeats  copies of l lie i times this apart, rad/s; 0: there are none
[[nodiscard]] std::vector<const linalg::ComplexPair *>
missing(const std::vector<linalg::ComplexPair> &some,
        const std::vector<linalg::ComplexPair> &others, double speed, double repeats);

/// Shapes good for one speed are added to those for another, and static deflections to both, so
/// that together they are more than the motions need. Of what they span as few as describe all
/// motions over a range of speeds equally well: the principal parts of motions at many speeds,
/// looked at again at just these and compared with those of all shapes.
/// @param all     N x r planar shapes that are good for the range
/// @param solver  on these shapes
/// @param speeds  ascending
/// @returns `all` where hardly fewer do
[[nodiscard]] std::shared_ptr<const Eigen::MatrixXd>
compact_shapes(const StabilityModel &model, const balancers::Arrangement &arrangement,
               const std::shared_ptr<const Eigen::MatrixXd> &all, const MotionSolver &solver,
               const std::vector<double> &speeds);

} // namespace whirl::stability
