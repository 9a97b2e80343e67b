#pragma once

#include <algorithm>
#include <cmath>

namespace whirl::linalg {

/// Where a function changes sign between a and b, by inverse quadratic interpolation that falls
/// back to bisection (Chandrupatla, Advances in Engineering Software 28 (1997) 145). The bracket is
/// kept throughout, so that a pole that changes sign is found as well as a zero.
///
/// @param fa,fb  values at a and b, of different signs
/// @param relative  width of the last bracket over the larger of |a|, |b|
template <class Function>
double bracketed_root(Function &&f, double a, double fa, double b, double fb,
                      double relative = 1e-13) {
    if (fa == 0)
        return a;
    if (fb == 0)
        return b;
    const double width = 0.5 * relative * std::max(std::abs(a), std::abs(b));
    double c = a;
    double fc = fa;
    double t = 0.5;
    for (int step = 0; step < 200; ++step) {
        const double x = a + t * (b - a);
        const double fx = f(x);
        if ((fx > 0) == (fa > 0)) {
            c = a;
            fc = fa;
        } else {
            c = b;
            fc = fb;
            b = a;
            fb = fa;
        }
        a = x;
        fa = fx;
        const double nearest = std::abs(fa) < std::abs(fb) ? a : b;
        const double share = width / std::abs(b - a);
        if (share > 0.5 || fa == 0)
            return fa == 0 ? a : nearest;
        const double xi = (a - b) / (c - b);
        const double phi = (fa - fb) / (fc - fb);
        t = 0.5;
        if (phi * phi < xi && (1 - phi) * (1 - phi) < 1 - xi)
            t = fa / (fb - fa) * fc / (fb - fc) +
                (c - a) / (b - a) * fa / (fc - fa) * fb / (fc - fb);
        t = std::clamp(t, share, 1 - share);
    }
    return 0.5 * (a + b);
}

} // namespace whirl::linalg
