#pragma once

#include "assembly/discretization.h"
#include "modes/whirl_mode.h"
#include "results/formulation.h"

#include <Eigen/Core>

#include <vector>

namespace whirl::modes {

/// Rigid motions that no support resists: their eigenvalues are exactly zero, and known without
/// an eigensolver, which could only return them blurred (the double zero of a free translation
/// splits into +-sqrt(rounding)).
struct ZeroModes {
    /// One a column, over the unknowns of the form. Translations before tilts about the centre of
    /// mass; in real form each in x, then in y, where both planes are free alike.
    Eigen::MatrixXd motions;
    int eigenvalues = 0;          ///< zero eigenvalues, counted with multiplicity
    std::vector<WhirlMode> modes; ///< the whirl modes of zero frequency that they make
};

/// Zero modes of the free motions there are (free_motions.h) with their damping and gyroscopic
/// coupling. Planar: unknowns of one plane, each eigenvalue is one whirl mode. Hyperbolic and
/// general: pairs x, y, two eigenvalues make one whirl mode.
/// @param bearing_speed  rad/s, of the bearings' coefficients
/// @param spin_speed     rad/s, of the gyroscopic coupling
[[nodiscard]] ZeroModes zero_modes(const assembly::Discretization &discretization,
                                   results::Form form, double bearing_speed, double spin_speed);

} // namespace whirl::modes
