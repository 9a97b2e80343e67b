#pragma once

#include "closed_form/anisotropic_rotor.h"
#include "closed_form/composite_rotor.h"

#include <complex>
#include <vector>

namespace whirl::closed_form {

/// A composite rotor on its supports, balls held; dimensional or dimensionless.
struct RotatingCoefficients {
    double mass = 0.0;               ///< M_s
    double mean_inertia = 0.0;       ///< A_Sigma
    double polar_inertia = 0.0;      ///< C
    std::complex<double> anisotropy; ///< a = (A_m0 + A_m D)/2
    double balancer_position = 0.0;  ///< z_A
    ReducedSupports supports;
};

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
