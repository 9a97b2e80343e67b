#pragma once

#include "closed_form/anisotropic_rotor.h"
#include "closed_form/pendulum_balancer.h"

#include <complex>
#include <vector>

namespace whirl::closed_form {

/// From masses (kg) of disc and one pendulum, arm and pivot radius (m); without damping and
/// imbalance.
[[nodiscard]] PendulumRotor pendulum_rotor(double disc_mass, double pendulum_mass, double arm,
                                           double pivot);

/// Without damping the deflection with balancer is unbounded at this speed ratio: 1/sqrt(1 + rho).
[[nodiscard]] double balancer_resonance(const PendulumRotor &rotor);

/// Complex coefficients, from lambda^4 down, of the small motions about phi = psi = 0:
/// [mu + H (l + i R) + 1][l^2 + h l + R_a R^2] - R_m mu^2, mu = (l + i R)^2.
[[nodiscard]] std::vector<std::complex<double>> pendulum_polynomial(const PendulumRotor &rotor,
                                                                    double speed_ratio);

/// Largest real part of its four roots.
[[nodiscard]] double small_motion_growth(const PendulumRotor &rotor, double speed_ratio);

/// Unstable speed ratios in (from, to) of the perfectly balanced rotor, ends refined to 1e-12;
/// found on a grid of `samples` speeds. An end that equals `to` means: still so there.
[[nodiscard]] std::vector<Band> unstable_speed_ratios(const PendulumRotor &rotor, double from,
                                                      double to, int samples = 2000);

} // namespace whirl::closed_form
