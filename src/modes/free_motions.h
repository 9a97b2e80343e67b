#pragma once

#include "assembly/discretization.h"
#include "results/formulation.h"

#include <Eigen/Core>

namespace whirl::modes {

/// Motions that strain nothing: the shaft rigid, bearings and pedestals unstretched.
struct FreeMotions {
    /// One a column, over the unknowns of the form. Translation before tilt about the centre of
    /// mass; in real form each in x, then in y, where both planes are free alike.
    Eigen::MatrixXd motions;
    /// Damping and gyroscopic coupling between them, each motion scaled to unit mass, 1/s.
    Eigen::MatrixXd damping;
    double scale = 0; ///< of the terms that `damping` is the sum of, 1/s: what is far below is
                      ///< rounding, as of a damper where a motion has its node
};

/// Decided by the constraints that the rotor has, one row for each spring there is, whatever its
/// stiffness: sums of element stiffnesses would have to resolve a soft bearing beside the rounding
/// of a stiff shaft. Springs whose forces cancel (a negative beside a positive stiffness) do
/// constrain.
/// @param bearing_speed  rad/s, of the bearings' coefficients
/// @param spin_speed     rad/s, of the gyroscopic coupling in `damping`
[[nodiscard]] FreeMotions free_motions(const assembly::Discretization &discretization,
                                       results::Form form, double bearing_speed, double spin_speed);

} // namespace whirl::modes
