#pragma once

#include "model/rotor.h"

#include <Eigen/Core>

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

/// The matrix of dense_solve().
[[nodiscard]] Eigen::MatrixXd state_matrix(const model::Rotor &rotor, int order, int refinement,
                                           double speed);

/// Imaginary parts of the eigenvalues by dgeev, with the right eigenvectors or without.
Eigen::VectorXd dense_frequencies(Eigen::MatrixXd matrix, bool vectors);

/// Steady motion under the imbalances at one speed as one full complex system A q = f.
struct DenseHarmonic {
    Eigen::MatrixXcd A;
    Eigen::VectorXcd f;
};
[[nodiscard]] DenseHarmonic dense_harmonic(const model::Rotor &rotor, int order, double speed);

/// q by LAPACK's zgesv: x and y of each planar unknown in pairs.
Eigen::VectorXcd dense_motion(DenseHarmonic problem);

} // namespace whirl::benchmarks
