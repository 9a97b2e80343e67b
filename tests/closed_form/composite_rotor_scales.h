#pragma once

#include "closed_form/composite_rotor_parameters.h"

namespace whirl::closed_form {

/// What the dimensionless parameters leave open.
struct ParameterScales {
    double mass = 0.0;             ///< kg, M_s
    double radius = 0.0;           ///< m, rho_s
    double frequency = 0.0;        ///< rad/s, omega_0
    int ball_count = 0;            ///< n
    double imbalance_radius = 0.0; ///< m, R0; with m0 = 0 unused and the moment in `own_moment`
    double own_moment = 0.0;       ///< kg m, moment of an imbalance that adds no mass
};

[[nodiscard]] ParameterScales scales_of(const PhysicalParameters &physical);
[[nodiscard]] PhysicalParameters to_physical(const DimensionlessParameters &dimensionless,
                                             const ParameterScales &scales);

/// Dimensionless p^2, c_y, h_beta, h_y of two equal supports: with l = l_cL / span (0 < l < 1
/// between the supports, l > 1 overhung) and rho = rho_s / span, p^2 = [l^2 + (1 - l)^2]/(2 rho^2),
/// c_y = (1 - 2 l)/(2 rho); h_beta and h_y are h_x times the same.
void set_equal_supports(DimensionlessParameters &parameters, double left_distance, double radius,
                        double h_x);

} // namespace whirl::closed_form
