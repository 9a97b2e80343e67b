#pragma once

#include "model/attachments.h"

#include <complex>

namespace whirl::balancers {

/// An auto-balancer at its balanced position as a linear element of a rotating node. With w, phi
/// the deflection and slope of the node in rotating axes, a_A = w'' + 2 i Omega w' - Omega^2 w and
/// sigma (m) the displacement of the moving masses from balance, averaged over their mass:
///
///     node:   + moving_mass (sigma'' + 2 i Omega sigma' - Omega^2 sigma), and as a rigid body:
///             mass, diametral and polar inertia, anisotropy * conj(phi'' + Omega^2 phi)
///     itself: sigma'' + damping sigma' + restoring Omega^2 sigma
///             + 1/2 [a_A - second_harmonic conj(a_A)] = 0
///
/// Balls: A. N. Gorbenko, Mass-inertia characteristics and dimensionless equations of motion of a
/// rotor with an auto-balancer, with the complex second harmonic of the arrangement. Pendulums: G.
/// Filimonikhin et al., four-pendulum auto-balancer with ties, linear in the angles.
struct BalancerElement {
    double z = 0;                         ///< m
    double moving_mass = 0;               ///< n m, kg
    double mass = 0;                      ///< n m + m0, kg
    double diametral_inertia = 0;         ///< (A_m + A_m0)/2, kg m2
    double polar_inertia = 0;             ///< A_m + A_m0, kg m2
    std::complex<double> anisotropy;      ///< (A_m0 + A_m D)/2, kg m2
    std::complex<double> second_harmonic; ///< D
    double damping = 0;                   ///< h_s, 1/s
    double restoring = 0;                 ///< 0 for balls, a/l for pendulums
};

/// @param second_harmonic  D = (1/n) sum exp(2 i angle) of the balls, angles in the rotor (not from
///                         the imbalance); not read for pendulums
[[nodiscard]] BalancerElement balancer_element(const model::Balancer &balancer,
                                               std::complex<double> second_harmonic);

} // namespace whirl::balancers
