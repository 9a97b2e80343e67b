#pragma once

#include <Eigen/Core>

namespace whirl::elements {

/// Matrices of an axisymmetric element in one plane, rows and columns over its unknowns
/// (deflections w in m, slopes phi in rad); docs/conventions.md has frames and signs.
/// Kinetic energy of both planes: 1/2 w'^H M w'; the spin couples the planes by G.
struct PlanarMatrices {
    Eigen::MatrixXd M;         ///< mass and rotary inertia, symmetric, positive semidefinite
    Eigen::MatrixXd G;         ///< polar inertia, symmetric: enters as -i speed G for w = x + i y
    Eigen::MatrixXd K;         ///< elastic stiffness, symmetric, positive semidefinite
    Eigen::MatrixXd K_axial;   ///< stiffness by axial force, symmetric
    Eigen::MatrixXd K_bending; ///< the part of K without shear
    /// By axial torque, skew: i times it stands in the stiffness for w = x + i y; empty without.
    Eigen::MatrixXd torque{};
};

} // namespace whirl::elements
