#pragma once

#include <optional>
#include <vector>

namespace whirl::closed_form {

/// Open interval of spin speed (rad/s, or dimensionless where the caller is); no `to`: up to
/// infinity.
struct Band {
    double from = 0.0;
    std::optional<double> to;

    [[nodiscard]] bool contains(double speed) const { return speed > from && (!to || speed < *to); }
};

/// Rigid rotor with unequal diametral inertias 1 - a and 1 + a, symmetric on isotropic supports:
/// its tilt motion, dimensionless (mean diametral inertia 1, time unit 1/omega_0). Source: A. N.
/// Gorbenko, On the permissible level of inertial anisotropy of a gyroscopic rotor. Physical values
/// may be used as they are after division by the mean diametral inertia A (kg m2): p2 = c_beta/A, h
/// = h_beta/A, speeds in rad/s.
struct AnisotropicRotor {
    double polar_inertia = 0.0; ///< C over the mean diametral inertia
    double anisotropy =
        0.0; ///< a = half the difference of the diametral inertias over their mean, >= 0
    double frequency = 0.0; ///< p, natural frequency of tilt at rest
    double damping = 0.0;   ///< h, tilt damping over the mean diametral inertia
};

/// long: C < 1, spherical: C = 1, short: C > 1 (exact comparison with a rounding allowance of
/// 1e-12).
enum class RotorType { long_rotor, spherical, short_rotor };
[[nodiscard]] RotorType rotor_type(double diametral_inertia, double polar_inertia);

/// Undamped forward critical speeds p/sqrt(1 - C + a), p/sqrt(1 - C - a), ascending: two for C < 1
/// - a, one for 1 - a <= C < 1 + a, none beyond. Equal ones (a = 0) are listed once.
[[nodiscard]] std::vector<double> critical_speeds(const AnisotropicRotor &rotor);

/// Unstable spin speeds (a4 < 0). Two ends for 1 - C > a; no upper end for |1 - C| < a; nothing for
/// C > 1 + a or where damping is large enough.
[[nodiscard]] std::optional<Band> unstable_band(const AnisotropicRotor &rotor);

/// Largest anisotropy that is stable at one spin speed: sqrt[(p^2/Omega^2 - (1 - C))^2 +
/// h^2/Omega^2].
[[nodiscard]] double permissible_anisotropy(const AnisotropicRotor &rotor, double spin_speed);

struct PermissibleAnisotropy {
    double anisotropy = 0.0;          ///< largest value stable at every speed (as an infimum)
    std::optional<double> spin_speed; ///< where it is least; none: approached as Omega -> infinity
};

/// Permissible anisotropy over all speeds: (h/p) sqrt(1 - C - h^2/(4 p^2)) while 1 - C > h^2/(2
/// p^2), else the infimum |1 - C|, approached at infinite speed.
[[nodiscard]] PermissibleAnisotropy permissible_anisotropy(const AnisotropicRotor &rotor);

/// Permissible anisotropy over the speeds from `from` to `to` (the ends included).
[[nodiscard]] PermissibleAnisotropy permissible_anisotropy(const AnisotropicRotor &rotor,
                                                           double from, double to);

} // namespace whirl::closed_form
