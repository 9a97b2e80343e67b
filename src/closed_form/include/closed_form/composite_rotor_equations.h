#pragma once

#include "closed_form/anisotropic_rotor.h"
#include "closed_form/composite_rotor_parameters.h"

#include <complex>
#include <vector>

namespace whirl::closed_form {

/// Coefficients of the equations in the rotating frame, dimensional or dimensionless:
/// M_s a_C + h_x w' + h_y phi' + c_x w + c_y phi + b = 0,
/// A (phi'' ) - i Omega C phi' + a conj(phi'' + Omega^2 phi) + h_beta phi' + h_y w' + c_beta phi +
/// c_y w
///   + z_A b = 0 and s'' + h_s s' + (n m/2)(a_A - D conj a_A) = 0,
/// where primes on w, phi outside the conjugate are absolute (d/dt + i Omega) and b = s'' + 2 i
/// Omega s'
/// - Omega^2 s.
struct RotatingCoefficients {
    double mass = 0.0;               ///< M_s
    double mean_inertia = 0.0;       ///< A_Sigma
    double polar_inertia = 0.0;      ///< C
    std::complex<double> anisotropy; ///< a = (A_m0 + A_m D)/2
    double balancer_position = 0.0;  ///< z_A
    ReducedSupports supports;
    double ball_mass = 0.0;               ///< n m
    double h_s = 0.0;                     ///< h_A / m
    std::complex<double> second_harmonic; ///< D
    double spin_speed = 0.0;              ///< Omega
};
[[nodiscard]] RotatingCoefficients rotating_coefficients(const PhysicalParameters &physical);
[[nodiscard]] RotatingCoefficients
rotating_coefficients(const DimensionlessParameters &dimensionless);

/// Forward critical speeds with the balls held (rad/s, ascending; up to four): for each principal
/// inertia A_Sigma -+ |a|, (c_x - M W^2)(c_beta - (A_Sigma -+ |a| - C) W^2) = c_y^2.
[[nodiscard]] std::vector<double> critical_speeds(const RotatingCoefficients &coefficients);

/// Additional speeds (zero root with the balls free, |D| < 1): critical speeds of the rotor pinned
/// at the balancer, (c_beta + c_x z_A^2 - 2 c_y z_A)/(A_Sigma -+ |a| + M_s z_A^2 - C), square root;
/// ascending.
[[nodiscard]] std::vector<double> additional_speeds(const RotatingCoefficients &coefficients);

/// Tilt of a composite rotor symmetric on its supports, balls held: division by A_Sigma, speeds in
/// rad/s.
[[nodiscard]] AnisotropicRotor tilt_rotor(const RotatingCoefficients &coefficients);

} // namespace whirl::closed_form
