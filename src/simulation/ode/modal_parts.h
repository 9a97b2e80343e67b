#pragma once

#include "linalg/lanes/complex4.h"

#include <Eigen/Core>

#include <cstring>

// Complex numbers with their real parts, filled up to whole vectors, above the imaginary ones.

namespace whirl::simulation {

/// @param whole  entries of each part
template <class Numbers>
[[nodiscard]] Eigen::VectorXd parts_of(const Numbers &numbers, Eigen::Index whole) {
    Eigen::VectorXd out = Eigen::VectorXd::Zero(2 * whole);
    for (Eigen::Index i = 0; i < numbers.size(); ++i) {
        out(i) = numbers(i).real();
        out(whole + i) = numbers(i).imag();
    }
    return out;
}

/// Four numbers, their imaginary parts so many entries after the real ones.
WHIRL_INLINED linalg::Complex4 four_at(const double *values, Eigen::Index apart) {
    linalg::Complex4 out;
    std::memcpy(&out.re, values, sizeof out.re);
    std::memcpy(&out.im, values + apart, sizeof out.im);
    return out;
}

/// sum += sign w z, each `count` real parts above as many imaginary ones.
template <int sign>
WHIRL_INLINED void add_products(const double *w, const double *z, Eigen::Index count, double *sum) {
    for (Eigen::Index i = 0; i < count; ++i) {
        const double along = w[i] * z[i] - w[count + i] * z[count + i];
        const double across = w[i] * z[count + i] + w[count + i] * z[i];
        sum[i] += sign * along;
        sum[count + i] += sign * across;
    }
}

} // namespace whirl::simulation
