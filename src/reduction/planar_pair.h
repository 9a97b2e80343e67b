#pragma once

#include "assembly/discretization.h"

#include <Eigen/SparseCore>

namespace whirl::reduction {

/// The whole rotor in one plane, bearings by the mean of their coefficients over the directions.
struct PlanarPair {
    Eigen::SparseMatrix<double> M;
    Eigen::SparseMatrix<double> G; ///< of the gyroscopic coupling of the planes
    Eigen::SparseMatrix<double> K;
};

/// Bearings as at `speed` (rad/s).
[[nodiscard]] PlanarPair planar_pair(const assembly::Discretization &discretization, double speed);

} // namespace whirl::reduction
