#pragma once

#include <functional>
#include <optional>
#include <vector>

namespace whirl::modes {

/// A way around a circle: arcs of equal length to begin with.
struct CircleWay {
    double start = 0; ///< rad
    double length = 0;
    int arcs = 12;
    bool closed = true; ///< its end is its start
};

/// Of the phase at each of some angles.
using Phases = std::function<std::vector<double>(const std::vector<double> &angles)>;

/// How far a phase turns along the way, rad; an arc over which it turns by much is halved. Nothing
/// where it jumps: an eigenvalue lies on the circle. (A turn by 2 pi within an arc is not seen:
/// circle_of_known.)
[[nodiscard]] std::optional<double> winding(const Phases &phases, const CircleWay &way);

/// A circle for what eigenvalues are counted against: the argument of a ratio of two functions of
/// z. A zero of the one close inside its circle and a zero of the other close outside of its own
/// turn it by 2 pi between two points of the way, and by nothing else. So the zeros of the other
/// are to be known, and divided out, to somewhat beyond its circle.
/// @param sizes   moduli of its zeros that are known
/// @param all_in  all of less modulus are
/// @param near    wanted radius
/// @returns the largest radius up to that which is away from all of them
[[nodiscard]] double circle_of_known(const std::vector<double> &sizes, double all_in, double near);

} // namespace whirl::modes
