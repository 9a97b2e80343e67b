#pragma once

#include "model/rotor.h"

#include <vector>

namespace whirl::benchmarks {

/// What a program does that knows nothing of the structure: all eigenvalues of the dense state
/// matrix at every speed.
struct DenseSolve {
    int states = 0;                  ///< size of the state matrix
    double seconds = 0;              ///< for one speed, without assembly
    std::vector<double> frequencies; ///< positive imaginary parts, ascending, rad/s
};

/// Eigenvalues of [0 I; -M^-1 K, -M^-1 (C + speed G)] by LAPACK's dgeev (which NumPy and SciPy
/// call for the same task), best of `repeats`.
///
/// @param order, refinement  of the shaft elements; order 1: the usual two-node element
/// @param speed    spin speed, rad/s
/// @param vectors  with the right eigenvectors, which whirl directions need
[[nodiscard]] DenseSolve dense_solve(const model::Rotor &rotor, int order, int refinement,
                                     double speed, bool vectors, int repeats);

} // namespace whirl::benchmarks
