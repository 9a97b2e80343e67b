#pragma once

#include "assembly/assemble.h"
#include "linalg/harmonic_solve.h"
#include "linalg/matrix.h"

namespace whirl::assembly {

/// Isotropic, undamped, axisymmetric: M w'' - i speed G w' + K w = 0 for w = x + i y.
struct PlanarSystem {
    linalg::Matrix M; ///< symmetric positive definite
    linalg::Matrix G; ///< symmetric
    linalg::Matrix K; ///< symmetric positive semidefinite
};

/// The same from every direction, with damping and cross coupling:
/// M w'' + (C + i Cx - i speed G) w' + (K + i Kx - i speed Kc) w = 0, every matrix real and
/// symmetric. A bearing's kxy = -kyx stands in Kx with a minus; Kc is internal damping.
struct DampedPlanarSystem {
    linalg::Matrix M;
    linalg::Matrix C, Cx, G;
    linalg::Matrix K, Kx, Kc;
};

/// M q'' + (C + speed G) q' + (K + speed Kc) q = f, real unknowns in pairs (x, y); G and Kc, of
/// internal damping, are skew.
using FixedSystem = linalg::HarmonicTerms;

/// Bearings as at `speed` (rad/s); in one plane, by the mean of their coefficients over the
/// directions, which says all of isotropic ones.
[[nodiscard]] PlanarSystem assemble_planar(const Discretization &discretization, double speed);
[[nodiscard]] DampedPlanarSystem assemble_damped_planar(const Discretization &discretization,
                                                        double speed);
[[nodiscard]] FixedSystem assemble_fixed(const Discretization &discretization, double speed);

/// S of the symmetric hyperbolic form (w^2 M + w speed S - K) q = 0, where y stands for -i y and
/// the real form's G couples the planes: S = [0 G; G 0].
[[nodiscard]] linalg::Matrix hyperbolic_coupling(const Discretization &discretization);

} // namespace whirl::assembly
