#pragma once

namespace whirl::closed_form {

/// Isotropic supports reduced to the common centre of mass C: force per deflection (x), moment per
/// slope (beta), and force per slope = moment per deflection (y).
struct ReducedSupports {
    double c_x = 0.0;    ///< N/m
    double c_beta = 0.0; ///< N m
    double c_y = 0.0;    ///< N
    double h_x = 0.0;    ///< N s/m
    double h_beta = 0.0; ///< N m s
    double h_y = 0.0;    ///< N s
};

/// One support: stiffness N/m, damping N s/m, position z from C, m.
struct Support {
    double stiffness = 0.0;
    double damping = 0.0;
    double position = 0.0;
};

/// c_x = sum c, c_y = sum c z, c_beta = sum c z^2, and the same for damping. The left support is at
/// z = -l_cL, the right one at z = l_cR (negative for an overhung rotor).
[[nodiscard]] ReducedSupports reduced_supports(const Support &left, const Support &right);

} // namespace whirl::closed_form
