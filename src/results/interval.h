#pragma once

#include <compare>
#include <utility>

namespace whirl::results {

/// An open interval of spin speed, rad/s, or the least and the largest of a number.
struct Interval {
    double from = 0;
    double to = 0;

    auto operator<=>(const Interval &) const = default;
};

using EndErrors = std::pair<double, double>; ///< of both ends of an interval

} // namespace whirl::results
