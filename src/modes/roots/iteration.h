#pragma once

#include <Eigen/Core>

#include <cmath>
#include <complex>
#include <numbers>

namespace whirl::modes {

/// Distance of two directions, both of length 1.
inline double turned(const Eigen::VectorXcd &from, const Eigen::VectorXcd &to) {
    const std::complex<double> along = from.dot(to);
    const double size = std::abs(along);
    return size > 0 ? (to - along / size * from).norm() : std::numbers::sqrt2;
}

/// The root of a l^2 + b l + c next to a value, by Newton's method.
inline std::complex<double> next_root(std::complex<double> a, std::complex<double> b,
                                      std::complex<double> c, std::complex<double> l) {
    for (int step = 0; step < 8; ++step) {
        const std::complex<double> change = ((a * l + b) * l + c) / (2.0 * a * l + b);
        l -= change;
        if (!(std::abs(change) > 1e-16 * std::abs(l)))
            break;
    }
    return l;
}

} // namespace whirl::modes
