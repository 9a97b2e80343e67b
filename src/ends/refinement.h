#pragma once

#include "modes/form_matrices.h"
#include "modes/roots/whole_pencil.h"

#include <Eigen/Core>

#include <complex>
#include <optional>

namespace whirl::ends {

/// A motion of the whole rotor, to begin with or found.
struct WholeMotion {
    double speed = 0;             ///< rad/s
    std::complex<double> value;   ///< l, 1/s
    Eigen::VectorXcd right, left; ///< Q(l) right = 0, left^H Q(l) = 0
    std::complex<double> rate;    ///< dl/dspeed towards higher speeds
    double noise = 0;             ///< found: how far rounding of the matrices can move l, 1/s
};

/// The speed next to `guess` at which a root i w of the whole rotor lies on the imaginary axis:
/// Newton's method for y^H Q(i w, speed) x = 0, two real equations for w and the speed, with x and
/// y by inverse iteration at each step, so that its error is squared twice over.
/// @param at_zero  w is zero and stays so: one equation for the speed
/// @returns nothing where it does not converge
[[nodiscard]] std::optional<WholeMotion> on_the_axis(const modes::FormMatrices &whole,
                                                     const WholeMotion &guess, bool at_zero);

/// The root of the whole rotor next to `guess` at its speed.
/// @param whole   at that speed
/// @param pencil  keeps the order of elimination from one root to the next
/// @returns nothing where it does not converge
[[nodiscard]] std::optional<WholeMotion> at_its_speed(const modes::QuadraticAt &whole,
                                                      const WholeMotion &guess,
                                                      modes::WholePencil<double> &pencil);

} // namespace whirl::ends
