#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

namespace whirl::tracking {

/// A distance is zero below this share of the frequency, and a step too short to be split below
/// this share of the speed: eigenvalues are known to some 1e-12, or to their rounding.
inline constexpr double resolved = 1e-11;

/// Distance of a whirl frequency from a multiple of the spin speed at one end of a step, with its
/// slope there (not a number where unknown).
struct StepEnd {
    double speed = 0;
    double distance = 0;
    double slope = 0;
    double tolerance = 0; ///< a distance below this is zero

    /// How far off a root next to it may be found, rad/s.
    [[nodiscard]] double margin() const {
        constexpr double largest = 1e-3; // of the speed: of a line along the multiple
        const double of_distance = tolerance / std::abs(slope);
        const double speed_here = std::abs(speed);
        return of_distance > resolved * speed_here ? std::min(of_distance, largest * speed_here)
                                                   : resolved * speed_here; // slope not known too
    }
};

/// Speed inside the step at which the distance must be evaluated: near a root, where the ends or
/// their slopes show that there is one, or where the cubic through both ends and slopes comes close
/// to zero between (two roots in one step). None where nothing can cross.
/// @param depth  steps that this one is part of: one that bends is halved a few times to make sure
[[nodiscard]] std::optional<double> next_probe(const StepEnd &a, const StepEnd &b, int depth);

/// How much the distance of a whirl frequency from a multiple of the spin speed changes at most
/// over a step, rad/s. A frequency changes by no more than twice the speed's change (a thin disc's
/// conical whirl); where a bearing table is steeper it may by more.
[[nodiscard]] inline double most_change(double step, double multiple) {
    constexpr double safety = 1.5;
    return safety * (multiple + 2) * std::abs(step);
}

/// Of a motion in rotating axes, whose frequencies in the fixed frame are all ±ω + 2kΩ: whether
/// another one of these is the largest at the other end of the step, so that the frequency shown
/// jumps, and neither of the two comes to the multiple within the step.
[[nodiscard]] bool jumps_past(const StepEnd &a, const StepEnd &b, double multiple);

} // namespace whirl::tracking
