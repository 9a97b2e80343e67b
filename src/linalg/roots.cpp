#include "linalg/roots.h"

#include "linalg/check.h"

#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/toms748_solve.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace whirl::linalg {

double root_between(const Function &f, double a, double fa, double b, double fb, double relative) {
    if (fa == 0)
        return a;
    if (fb == 0)
        return b;
    if ((fa > 0) == (fb > 0))
        throw SolverError("a root was looked for between two values of one sign");
    if (a > b) {
        std::swap(a, b);
        std::swap(fa, fb);
    }
    const double width = relative * std::max(std::abs(a), std::abs(b));
    std::uintmax_t steps = 200;
    // Poles may give infinity, which cannot be interpolated with.
    const auto finite = [](double value) { return std::clamp(value, -1e100, 1e100); };
    const auto [low, high] = boost::math::tools::toms748_solve(
        [&](double x) { return finite(f(x)); }, a, b, finite(fa), finite(fb),
        [width](double from, double to) { return to - from <= width; }, steps);
    return (low + high) / 2;
}

double least_place(const Function &f, double low, double high) {
    std::uintmax_t steps = 60;
    constexpr int half_the_digits = 26; // of 53
    return boost::math::tools::brent_find_minima(f, low, high, half_the_digits, steps).first;
}

std::pair<double, double>
least_between(const Function &f, double low, double high,
              const std::function<bool(double low, double high, double least)> &done) {
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
