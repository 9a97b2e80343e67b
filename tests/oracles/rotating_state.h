#pragma once

#include "oracles/criterion.h"
#include "oracles/influence.h"
#include "oracles/rigid_rotor.h"

namespace whirl::oracles {

/// Balls at their balanced position in one plane: two more unknowns, s = sum m R i exp(i alpha) eps
/// (eps: how far a ball is from its place), in rotating axes
///   on the plane      s'' + 2 i Omega s' - Omega^2 s
///   s'' + h s' + (n m/2)(a - D conj a) = 0,  a = u'' + 2 i Omega u' - Omega^2 u at the plane
/// (linearised Lagrangian of point balls in a race; composite rotor of Gorbenko). Their mass and
/// inertia belong to the matrices of the rotor.
struct BalancedBalls {
    Eigen::Matrix<Real, Eigen::Dynamic, 1> plane; ///< u at the plane = plane^T u
    Real mass = 0;                                ///< n m, kg
    Real damping = 0;                             ///< h_A/m, 1/s
    Complex D;                                    ///< (1/n) sum exp(2 i alpha)
};

/// Rotor in axes that turn with it, w = u exp(i Omega t), on isotropic supports:
/// M(u'' + 2 i Omega u' - Omega^2 u) - i Omega G (u' + i Omega u) + Ce (u' + i Omega u) + Ci u'
/// + K u + Ma conj(u'' + Omega^2 u) + Cia conj(u') + Ka conj(u) = 0, one complex unknown a row.
struct RotatingRotor {
    RealMatrix M, G, Ce, Ci, K;
    ComplexMatrix Ma;  ///< inertial anisotropy
    ComplexMatrix Ka;  ///< two bending stiffnesses
    ComplexMatrix Cia; ///< internal damping of the same
    std::vector<BalancedBalls> balls;

    explicit RotatingRotor(Eigen::Index size);
    /// Of the real form of first order, 1/s.
    [[nodiscard]] std::vector<Complex> eigenvalues(Real speed) const;
    /// Largest real part, 1/s.
    [[nodiscard]] Real growth(Real speed) const;
    /// What is left at lambda = 0, real form: singular at speeds with a zero root.
    [[nodiscard]] RealMatrix static_matrix(Real speed) const;
};

/// A rigid body about its centre of mass: unknowns w and phi.
[[nodiscard]] RotatingRotor rotating_body(const RigidRotor &body);
/// With the balls of the case free to move.
[[nodiscard]] RotatingRotor rotating_composite(const CaseRotor &rotor);
/// The disc of a case on its shaft, the mass of the shaft left out; unknowns w and phi at the disc.
[[nodiscard]] RotatingRotor rotating_disc(const CaseRotor &rotor);

/// The shaft of a case on two-node elements (dense_rotor()) in rotating axes, on bearings that are
/// the same from every direction: [[anisotropy]] where there is a node, segments with two bending
/// stiffnesses EI(1 +- asymmetry) and rotary inertias alike, the stiffer one in x, without
/// balancers.
[[nodiscard]] RotatingRotor rotating_shaft(const CaseRotor &rotor, int parts = 1);

/// Of M q'' + D q' + K q = 0, 1/s. `scale`: a frequency of their order, so that the entries of the
/// state matrix are of one size.
[[nodiscard]] std::vector<Complex> state_eigenvalues(const RealMatrix &M, const RealMatrix &D,
                                                     const RealMatrix &K, Real scale);

/// Whether a real part is above `noise` times the largest modulus.
[[nodiscard]] bool grows(const std::vector<Complex> &eigenvalues, Real noise);

/// Bands of spin speed in which motions grow: on a grid of `steps`, ends by bisection. `noise`:
/// growth of undamped motions by rounding, relative to the largest |lambda|; 0 with damping.
[[nodiscard]] std::vector<Band> growing_bands(const RotatingRotor &rotor, Real from, Real to,
                                              int steps, Real noise);

} // namespace whirl::oracles
