#pragma once

#include <cmath>
#include <functional>
#include <optional>

namespace whirl::tracking {

/// Whether a frequency jumps across a multiple (the larger part of the motion changes) between two
/// speeds: the square of its distance over the way to a branch point and over the speed is of the
/// order of 1, and such a frequency stays away.
/// @param square  of the distance from the multiple, (rad/s)^2
/// @param width   between the speeds, rad/s
[[nodiscard]] inline bool jumps_across(double square, double width, double speed) {
    // The constant of the square-root law is of order 1: 100 of it leaves no doubt of a jump.
    constexpr double steepest = 100;
    return square > steepest * width * std::abs(speed);
}

/// Between which two speeds a motion leaves a multiple of the spin speed.
struct BranchPoint {
    double inside = 0, outside = 0; ///< rad/s, apart by no more than asked for
};

/// At a speed the square of the distance of the nearest motion outside a band; nothing inside it.
using SquareAt = std::function<std::optional<double>(double)>;

/// The end of a band between a speed inside it and one outside. Beyond a branch point the distance
/// of the motion from the multiple grows as the square root of the way, so that the line through
/// the squares at the two nearest speeds outside leads to it; where it does not, as where the
/// frequency jumps, the part is halved.
/// @param relative  width of the result over the speed
[[nodiscard]] BranchPoint band_end(double inside, double outside, double relative,
                                   const SquareAt &square);

/// The same; nothing where the frequency jumps.
[[nodiscard]] std::optional<BranchPoint> branch_point(double inside, double outside,
                                                      double relative, const SquareAt &square);

} // namespace whirl::tracking
