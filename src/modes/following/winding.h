#pragma once

#include <functional>
#include <optional>

namespace whirl::modes {

/// A way around a circle: arcs of equal length to begin with.
struct CircleWay {
    double start = 0; ///< rad
    double length = 0;
    int arcs = 12;
    bool closed = true; ///< its end is its start
};

/// How far a phase turns along the way, rad; an arc over which it turns by much is halved. Nothing
/// where it jumps: an eigenvalue lies on the circle.
[[nodiscard]] std::optional<double> winding(const std::function<double(double angle)> &phase,
                                            const CircleWay &way);

} // namespace whirl::modes
