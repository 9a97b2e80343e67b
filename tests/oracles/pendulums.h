#pragma once

#include "oracles/case_rotor.h"

#include <string>

namespace whirl::oracles {

/// Disc in its plane on an isotropic support with four pendulums on two perpendicular lines, tied
/// in pairs (angles phi, psi); lengths in units of the arm, time in units of 1/omega0 (paper on the
/// four-pendulum balancer: R_w = Omega/omega0, M_sum = M + 4 m, omega0^2 = c/M_sum).
struct PendulumRotor {
    Real R_m = 0;    ///< 2 m/M_sum
    Real R_a = 0;    ///< a/l: radius of the pivots over the arm
    Real H = 0;      ///< H2/(M_sum omega0), external damping
    Real h = 0;      ///< H1/(m l^2 omega0), of a hinge
    Real u0 = 0;     ///< M e/(2 m l), the imbalance
    Real omega0 = 1; ///< rad/s

    [[nodiscard]] Real rho() const { return R_m / R_a; }
    /// R_w above which the approximate efficiency is below 1: 1/sqrt(1 + rho/2).
    [[nodiscard]] Real threshold() const;
    /// Its limit for fast rotation, 1/(1 + rho).
    [[nodiscard]] Real limit() const;
};

/// The case as a rigid body that moves parallel to itself, with its first balancer.
[[nodiscard]] PendulumRotor pendulum_rotor(const CaseRotor &rotor);
/// The same with other arms and pivots.
[[nodiscard]] PendulumRotor pendulum_rotor(const CaseRotor &rotor, const PendulumDesign &design);

/// Deflection with the pendulums at work over that without, sin = tan.
[[nodiscard]] Real approximate_efficiency(const PendulumRotor &rotor, Real R_w);
/// The same of the exact steady motion, by Newton's method from the approximate one.
[[nodiscard]] Real exact_efficiency(const PendulumRotor &rotor, Real R_w);

/// Largest growth (in units of omega0) of small motions about the position of balance: roots of
/// [mu + H(s + i R_w) + 1][s^2 + h s + R_a R_w^2] - R_m mu^2 = 0, mu = (s + i R_w)^2.
[[nodiscard]] Real linear_growth(const PendulumRotor &rotor, Real R_w);

/// What the motion from rest in the rotor ends in.
struct PendulumOutcome {
    Real swing = 0; ///< of the pendulums over the last fortieth of the time, rad
    Real drift = 0; ///< over the last tenth, rad
    /// "lagging" where a pendulum drifts by more than half a turn, else "whirling" where it swings
    /// by more than 0.05 rad, else "at rest".
    [[nodiscard]] std::string name() const;
};
/// Nonlinear equations of motion in rotating axes (d'Alembert), Runge-Kutta 4, 240 steps a turn.
[[nodiscard]] PendulumOutcome pendulum_motion(const PendulumRotor &rotor, Real R_w, Real phi,
                                              Real psi, Real time);

} // namespace whirl::oracles
