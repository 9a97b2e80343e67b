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

} // namespace whirl::closed_form
