#pragma once

#include "results/whirl.h"

#include <Eigen/Core>

#include <complex>
#include <vector>

namespace whirl::modes {

/// One whirl mode at one spin speed.
struct WhirlMode {
    std::complex<double> eigenvalue; ///< Im >= 0, 1/s
    /// Over the unknowns of the form. Planar: real w with w(t) = w exp(i s t), s = +-Im by
    /// `whirl`. Hyperbolic: real (x, y') with y = i y'. General: complex (x, y).
    Eigen::VectorXcd shape;
    results::Whirl whirl = results::Whirl::mixed;
    double forward_fraction = 0.5;
    double frequency_rotating = 0; ///< seen in rotating axes, rad/s; in rotating forms only
    /// The eigenpair in rotating axes, which is what can be followed; in form rotating only.
    std::complex<double> rotating_value;
    Eigen::VectorXcd rotating_vector;
    double residual = 0;
    double rounding = 0;
};

} // namespace whirl::modes
