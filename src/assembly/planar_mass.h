#pragma once

#include "assembly/discretization.h"

#include <Eigen/SparseCore>

namespace whirl::assembly {

/// Mass of the shaft and what turns with it over the unknowns of one plane: kinetic energy of a
/// motion, whatever the mesh.
[[nodiscard]] Eigen::SparseMatrix<double> planar_mass(const Discretization &discretization);

} // namespace whirl::assembly
