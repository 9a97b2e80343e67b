#pragma once

#include "assembly/discretization.h"
#include "linalg/matrix.h"

#include <Eigen/Core>

namespace whirl::analyses {

/// Rigid motions that no support resists: their eigenvalues are exactly zero, and known without
/// an eigensolver, which could only return them blurred (the double zero of a free translation
/// splits into +-sqrt(rounding)).
struct ZeroModes {
    Eigen::MatrixXd motions; ///< one a column, over the unknowns of the form
    int eigenvalues = 0;     ///< zero eigenvalues, counted with multiplicity
    int whirl_modes = 0;     ///< of them, how many whirl modes of zero frequency they make
};

/// Zero modes of l^2 M + l D + K in planar form (unknowns of one plane; `D` = speed G, for which
/// each eigenvalue is one whirl mode) or in real form (pairs x, y; conjugates make one).
[[nodiscard]] ZeroModes zero_modes(const assembly::Discretization &discretization, bool planar,
                                   const linalg::Matrix &D, const linalg::Matrix &K);

/// A frequency of the order of the first bending one of the free shaft, rad/s; never zero.
[[nodiscard]] double elastic_scale(const assembly::Discretization &discretization);

} // namespace whirl::analyses
