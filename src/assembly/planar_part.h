#pragma once

#include "assembly/assemble.h"

#include <Eigen/SparseCore>

namespace whirl::assembly {

/// One term of the shaft and what turns with it over the unknowns of one plane. Term::mass: kinetic
/// energy of a motion, whatever the mesh; Term::damping: of the shaft's material, N s/m.
[[nodiscard]] Eigen::SparseMatrix<double> planar_part(const Discretization &discretization,
                                                      Term term);

} // namespace whirl::assembly
