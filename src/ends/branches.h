#pragma once

#include "ends/spectrum.h"

#include <optional>
#include <vector>

namespace whirl::ends {

/// One motion over a step of speed: eigenvalues and rates at both ends, a cubic between them.
struct Branch {
    const Root *from = nullptr, *to = nullptr;
    double step = 0; ///< rad/s
    int cluster = 0; ///< of motions not distinguished that stay off the axis together, or none

    /// @param t  from 0 to 1
    [[nodiscard]] std::complex<double> at(double t) const;
};

/// The motions of a step, followed as far as values and rates at its ends identify them. Those that
/// cannot be distinguished are left out where this does not matter: all of them die out, or all
/// grow, by far more than they differ.
struct Branches {
    std::vector<Branch> branches;
    int clusters = 0;
    bool clear = true; ///< false: some that matter could not be followed
    double middle =
        0.5; ///< where to split the step; long ones near rest at the mean of the logarithms
};
[[nodiscard]] Branches followed(const Spectrum &from, const Spectrum &to);

/// Where in a step (between 0 and 1) another spectrum is needed before the signs of all real parts
/// are known throughout; nothing: they are.
///  - a motion could not be followed,
///  - a real part may pass zero twice, or its cubic is not to be trusted,
///  - two motions pass each other in frequency: coupling, however weak, shows right there, unless
///    it is known to be too weak (coupling.h).
/// @param from,to  at the ends of the step
/// @param scale  speed below whose rounding frequencies are equal, rad/s
[[nodiscard]] std::optional<double> where_to_refine(const Branches &branches, const Spectrum &from,
                                                    const Spectrum &to, double scale);

} // namespace whirl::ends
