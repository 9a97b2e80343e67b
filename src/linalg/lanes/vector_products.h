#pragma once

#include <Eigen/Core>

#include <complex>
#include <vector>

namespace whirl::linalg {

// Of complex vectors of one size, two entries in one instruction.

/// a^H b
[[nodiscard]] std::complex<double> dot(const Eigen::VectorXcd &a, const Eigen::VectorXcd &b);

/// y += f x
void add_multiple(std::complex<double> f, const Eigen::VectorXcd &x, Eigen::VectorXcd &y);

/// A vector times a real number.
struct RealMultiple {
    double f;
    const Eigen::VectorXcd *x;
};
/// Of at least one.
[[nodiscard]] Eigen::VectorXcd sum_of(const std::vector<RealMultiple> &terms);

} // namespace whirl::linalg
