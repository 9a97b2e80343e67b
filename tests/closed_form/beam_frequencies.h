#pragma once

#include <array>

namespace whirl::closed_form {

/// Uniform shaft, simply supported at both ends in both planes (deflection and bending moment
/// zero).
struct UniformShaft {
    double length = 0.0;            ///< m
    double area = 0.0;              ///< m2
    double second_moment = 0.0;     ///< m4, diametral second moment of area I
    double young_modulus = 0.0;     ///< Pa
    double density = 0.0;           ///< kg/m3
    double shear_modulus = 0.0;     ///< Pa, read by the Timoshenko theory only
    double shear_coefficient = 1.0; ///< kappa, effective over full shear area
};

/// Shaft of circular section, hollow where inner_radius > 0 (radii in m).
[[nodiscard]] UniformShaft circular_shaft(double length, double outer_radius, double inner_radius,
                                          double young_modulus, double density);

/// What a section resists acceleration with, apart from the gyroscopic moment, always kept.
enum class RotaryInertia {
    neglected, ///< rho A alone
    kept       ///< rho A + rho I k^2 (Rayleigh)
};

/// Whirl frequencies of one mode, rad/s, both positive; backward <= forward for spin speed >= 0.
struct WhirlPair {
    double backward = 0.0;
    double forward = 0.0;
};

/// Euler-Bernoulli whirl frequencies of mode n = 1, 2, ... at spin speed Omega (rad/s):
/// m w^2 -+ g Omega w - K = 0 with k = n pi / L, m = rho A (+ rho I k^2), g = 2 rho I k^2, K = E I
/// k^4. Source: R.-J. Gibert, Vibrations des structures, pp. 235-237.
[[nodiscard]] WhirlPair euler_whirl(const UniformShaft &shaft, int mode, double spin_speed,
                                    RotaryInertia rotary_inertia);

/// Forward critical speed of mode n (rad/s): K = Omega^2 (m - g); 0 where m <= g, i.e. where the
/// gyroscopic moment removes the critical speed.
[[nodiscard]] double euler_forward_critical(const UniformShaft &shaft, int mode,
                                            RotaryInertia rotary_inertia);

/// Timoshenko whirl frequencies with wave number n pi / L, ascending (rad/s, sign = sense of whirl,
/// forward positive): two bending and two shear frequencies, roots of
/// (-rho A w^2 + kGA k^2) (-rho I w^2 + 2 rho I Omega w + E I k^2 + kGA) - (kGA k)^2 = 0,
/// from w = W sin(kz), phi = Phi cos(kz). All four are real.
[[nodiscard]] std::array<double, 4> timoshenko_whirl(const UniformShaft &shaft, int mode,
                                                     double spin_speed);

} // namespace whirl::closed_form
