#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <vector>

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

/// Two motions next to a multiple of the spin speed at a speed: outside a band the square of the
/// distance of both from it, inside with a minus that of half of what their real parts differ by.
/// This is (with a minus) the discriminant of the two roots, which passes through an end of the
/// band as a smooth function, and over a narrow band is a parabola.
struct Pair {
    double speed = 0;  ///< rad/s
    double square = 0; ///< (rad/s)^2; minus infinity: inside, not known
};
using SquareAt = std::function<double(double speed)>;

/// Between which two speeds a motion leaves a multiple of the spin speed.
struct BranchPoint {
    double inside = 0, outside = 0; ///< rad/s, apart by no more than asked for
};

/// The end of a band between a speed inside it and one outside, where the parabola through the
/// squares at the three nearest speeds leads to; where it does not, as where the frequency jumps,
/// the part is halved.
/// @param relative  width of the result over the speed
/// @param others    squares at other speeds, if known
[[nodiscard]] BranchPoint band_end(const Pair &inside, const Pair &outside, double relative,
                                   const SquareAt &square, std::vector<Pair> others = {});

/// The same; nothing where the frequency jumps.
[[nodiscard]] std::optional<BranchPoint> branch_point(const Pair &inside, const Pair &outside,
                                                      double relative, const SquareAt &square);

} // namespace whirl::tracking
