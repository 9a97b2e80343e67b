#pragma once

#include "periodic/whole_root.h"

#include <complex>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace whirl::periodic {

/// A motion of the whole rotor that neither grows nor dies out: Re l = 0.
struct Neutral {
    double speed = 0;           ///< rad/s
    std::complex<double> value; ///< l, 1/s
    double slope = 0;           ///< of Re l by the speed
    double noise = 0;           ///< of the speed by rounding, rad/s
};

/// The speed next to a guess at which a motion becomes neutral, where Re l passes zero with a
/// slope (two motions that collide do not): Newton's method with the derivative of the root.
/// @param speed      not zero, rad/s
/// @param guess      of l, 1/s
/// @param frequency  that the motion is fastest at, rad/s
/// @param reach      how far from the guess, rad/s
/// @returns nothing where it is not found there
[[nodiscard]] std::optional<Neutral> neutral_next_to(const WholeRotor &rotor, double speed,
                                                     std::complex<double> guess, double frequency,
                                                     double reach);

/// Whole rotors with one number varied, of one mesh.
using Family = std::function<std::shared_ptr<const WholeRotor>(double number)>;

/// Where the largest Re l over the speed passes zero as a number varies: a band closes.
struct Closing {
    double number = 0;
    double speed = 0;           ///< rad/s
    std::complex<double> value; ///< l, 1/s
    double noise = 0;           ///< of the number by rounding
};

/// A band of the rotor with some number: its middle, and what grows there.
struct OpenBand {
    double speed = 0;           ///< rad/s
    double width = 0;           ///< rad/s
    std::complex<double> guess; ///< of l, 1/s
    double frequency = 0;       ///< that the motion is fastest at, rad/s
};

/// Of bands that close as the number decreases the last one: each is followed to where Re l = 0
/// and its derivative by the speed is 0, by Newton's method, the second derivatives by the steps
/// before (C. G. Broyden). Bands that close far above the least, as the growth in their middle
/// lets expect, are not followed.
/// @param number  greater than zero; what is found is less
/// @returns nothing where they cannot be followed
[[nodiscard]] std::optional<Closing> last_to_close(const Family &family, double number,
                                                   const std::vector<OpenBand> &bands);

} // namespace whirl::periodic
