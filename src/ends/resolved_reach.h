#pragma once

#include "assembly/discretization.h"

#include <Eigen/Core>

namespace whirl::ends {

/// Frequency (rad/s) up to which the elements resolve motions, one for all speeds: the planar modes
/// without damping at rest, bearings by their means over the directions as at `bearing_speed`, the
/// k-th against the k-th of finer elements (mesh_error::finer_order on the same mesh), whose
/// functions contain these, so that by Courant and Fischer none is lower and each belongs to the
/// one of its number. All below are within 1 % of theirs, with safety; it stands in the middle
/// (geometric) of the last one and the next. Infinite where all are, as on a rigid shaft.
/// @param shapes  the motions of the rotor are on these planar shapes, N x r; none: all
[[nodiscard]] double resolved_up_to(const assembly::Discretization &discretization,
                                    const Eigen::MatrixXd *shapes, double bearing_speed);

} // namespace whirl::ends
