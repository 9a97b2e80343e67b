#pragma once

#include <complex>
#include <vector>

namespace whirl::closed_form {

/// Planar rotor with a four-pendulum auto-balancer: arms l with masses m at their ends, hinged at
/// radius a on two perpendicular lines of the rotor, tied in opposite pairs that turn by equal
/// angles to opposite sides (phi on the first line, psi on the second). Source: Efficiency of
/// balancing of a rotor by a four-pendulum auto-balancer with ties.
/// Dimensionless: lengths by l, time by 1/omega_0, omega_0 = sqrt(c/M_Sigma), M_Sigma = M + 4 m.
struct PendulumRotor {
    double mass_ratio = 0.0;        ///< R_m = 2 m / M_Sigma
    double pivot_ratio = 0.0;       ///< R_a = a / l
    double external_damping = 0.0;  ///< H = H_2 / (M_Sigma omega_0)
    double hinge_damping = 0.0;     ///< h = H_1 / (m l^2 omega_0); drops out of steady motion
    std::complex<double> imbalance; ///< u_0 + i v_0 = M e exp(i beta) / (2 m l)

    /// rho = R_m / R_a: the larger, the better the balancing.
    [[nodiscard]] double effectiveness() const { return mass_ratio / pivot_ratio; }
};

/// One steady motion in the rotating frame: shaft position (in arm lengths) and pendulum angles.
struct PendulumMotion {
    std::complex<double> position; ///< xi + i eta
    double phi = 0.0;              ///< rad
    double psi = 0.0;              ///< rad
    bool stable = false;           ///< no small motion grows (growth below 1e-6)
    double growth = 0.0;           ///< largest real part of the eigenvalues, per 1/omega_0
};

/// Every steady motion with outward pendulums (|phi|, |psi| < pi/2) at speed ratio R_w =
/// omega/omega_0 > 0, ascending in |position|. Equations, with sin psi = -xi/sqrt(R_a^2 + xi^2),
/// sin phi likewise from eta: (1 - R_w^2) xi - R_w H eta + R_m R_w^2 sin psi = R_m R_w^2 u_0, R_w H
/// xi + (1 - R_w^2) eta - R_m R_w^2 sin phi = R_m R_w^2 v_0, R_a tan phi = eta, R_a tan psi = -xi.
/// Found by subdivision with bounds on both equations, so that none is missed. At R_w = 1, H = 0
/// there is no a priori bound on the position: none is returned beyond 1e3 arms.
[[nodiscard]] std::vector<PendulumMotion> steady_motions(const PendulumRotor &rotor,
                                                         double speed_ratio);

/// Shaft deflection with the balancer at work over that with pendulums held at phi = psi = 0.
[[nodiscard]] double exact_efficiency(const PendulumRotor &rotor, const PendulumMotion &motion,
                                      double speed_ratio);

/// The same for small angles (sin ~ tan):
/// n = sqrt{[(1 - R^2)^2 + R^2 H^2] / [(1 - R^2 (1 + rho))^2 + R^2 H^2]}.
[[nodiscard]] double approximate_efficiency(const PendulumRotor &rotor, double speed_ratio);

/// n < 1 for speed ratios above this: 1/sqrt(1 + rho/2), below the resonance already.
[[nodiscard]] double efficiency_threshold(const PendulumRotor &rotor);

/// n of fast rotation, 1/(1 + rho).
[[nodiscard]] double efficiency_limit(const PendulumRotor &rotor);

} // namespace whirl::closed_form
