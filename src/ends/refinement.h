#pragma once

#include "modes/form_matrices.h"
#include "modes/roots/whole_pencil.h"
#include "results/stability.h"

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

/// A motion of the whole rotor at an end of its growth: on the imaginary axis.
struct EndOfGrowth : WholeMotion {
    results::EndKind kind = results::EndKind::pair;
    int inward = 0;  ///< 1: it grows above its speed, -1: below
    double blur = 0; ///< how far rounding of the matrices can move the speed, rad/s
};

/// The speed next to `guess` at which a root i w of the whole rotor lies on the imaginary axis:
/// Newton's method for its real part, with the root and its rate at each speed.
/// @param at_zero  w is zero and stays so: the speed is the eigenvalue of K(speed) x = 0
/// @returns nothing where it does not converge
[[nodiscard]] std::optional<EndOfGrowth> on_the_axis(const modes::FormMatrices &whole,
                                                     const WholeMotion &guess, bool at_zero);

/// The speed next to `guess` at which two motions of the whole rotor, without damping, meet on the
/// imaginary axis and part: there y^H Q(i w, speed) x = 0 has a double root (double_root.h).
/// @param reach  how far from the guess's speed, rad/s
[[nodiscard]] std::optional<EndOfGrowth> collision(const modes::FormMatrices &whole,
                                                   const WholeMotion &guess, double reach);

/// The root of the whole rotor next to `guess` at its speed.
/// @param whole   at that speed
/// @param pencil  keeps the order of elimination from one root to the next
/// @returns nothing where it does not converge
[[nodiscard]] std::optional<WholeMotion> at_its_speed(const modes::QuadraticAt &whole,
                                                      const WholeMotion &guess,
                                                      modes::WholePencil<double> &pencil);

} // namespace whirl::ends
