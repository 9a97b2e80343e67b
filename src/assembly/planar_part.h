#pragma once

#include "assembly/assemble.h"

#include <Eigen/SparseCore>

namespace whirl::assembly {

/// One term of the shaft and what turns with it over the unknowns of one plane. Term::mass: kinetic
/// energy of a motion, whatever the mesh; Term::damping: of the shaft's material, N s/m.
[[nodiscard]] Eigen::SparseMatrix<double> planar_part(const Discretization &discretization,
                                                      Term term);

/// One term of the whole rotor over the unknowns of one plane, bearings as at `speed` (rad/s) by
/// the mean of their coefficients over the directions.
[[nodiscard]] Eigen::SparseMatrix<double> planar_matrix(const Discretization &discretization,
                                                        Term term, double speed);

/// Polar inertia of shaft, discs and what else turns with the shaft, kg m2: twice the energy of a
/// unit slope times the gyroscopic matrix.
[[nodiscard]] double polar_inertia(const Discretization &discretization);

} // namespace whirl::assembly
