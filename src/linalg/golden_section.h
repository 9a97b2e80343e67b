#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

namespace whirl::linalg {

/// Place and value of the least of a function between two places, by golden section; `done` sees
/// the ends of the bracket and the least value so far.
template <class Function, class Done>
std::pair<double, double> least_by_golden_section(Function &&f, double low, double high,
                                                  Done &&done) {
    const double ratio = (std::sqrt(5.0) - 1) / 2;
    double c = high - ratio * (high - low);
    double d = low + ratio * (high - low);
    double at_c = f(c);
    double at_d = f(d);
    while (!done(low, high, std::min(at_c, at_d))) {
        if (at_c < at_d) {
            high = d;
            d = c;
            at_d = at_c;
            c = high - ratio * (high - low);
            at_c = f(c);
        } else {
            low = c;
            c = d;
            at_c = at_d;
            d = low + ratio * (high - low);
            at_d = f(d);
        }
    }
    return at_c <= at_d ? std::pair(c, at_c) : std::pair(d, at_d);
}

} // namespace whirl::linalg
