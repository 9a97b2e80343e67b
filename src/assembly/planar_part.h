#pragma once

#include "assembly/assemble.h"

#include <Eigen/SparseCore>

namespace whirl::assembly {

/// One term of the shaft and what turns with it over the unknowns of one plane. Term::mass: kinetic
/// energy of a motion, whatever the mesh; Term::damping: of the shaft's material, N s/m.
[[nodiscard]] Eigen::SparseMatrix<double> planar_part(const Discretization &discretization,
                                                      Term term);

/// The whole rotor in one plane, bearings by the mean of their coefficients over the directions.
struct PlanarPair {
    Eigen::SparseMatrix<double> M;
    Eigen::SparseMatrix<double> G; ///< of the gyroscopic coupling of the planes
    Eigen::SparseMatrix<double> K;
};

/// Bearings as at `speed` (rad/s).
[[nodiscard]] PlanarPair planar_pair(const Discretization &discretization, double speed);

/// Polar inertia of shaft, discs and what else turns with the shaft, kg m2: twice the energy of a
/// unit slope times the gyroscopic matrix.
[[nodiscard]] double polar_inertia(const Discretization &discretization);

} // namespace whirl::assembly
