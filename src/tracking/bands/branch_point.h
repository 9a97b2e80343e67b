#pragma once

#include <functional>
#include <optional>

namespace whirl::tracking {

/// Square of the distance from the multiple over the way to the branch point and over the speed: of
/// the order of 1 there. A frequency that jumps (the larger part of the motion changes) stays away.
inline constexpr double steepest_branch = 100;

/// Between which two speeds a motion leaves a multiple of the spin speed.
struct BranchPoint {
    double inside = 0, outside = 0; ///< rad/s, apart by no more than asked for
};

/// The end of a band between a speed inside it and one outside. Beyond a branch point the distance
/// of the motion from the multiple grows as the square root of the way, so that the line through
/// the squares at the two nearest speeds outside leads to it; where it does not, the part is
/// halved.
/// @param square    at a speed, of the distance of the nearest motion outside the band; nothing
///                  inside it
/// @param relative  width of the result over the speed
/// @param or_jump   whether an end at which the frequency jumps is one; else nothing is returned
[[nodiscard]] std::optional<BranchPoint>
branch_point(double inside, double outside, double relative,
             const std::function<std::optional<double>(double)> &square, bool or_jump);

} // namespace whirl::tracking
