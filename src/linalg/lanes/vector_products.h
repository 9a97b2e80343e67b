#pragma once

#include <Eigen/Core>

#include <complex>

namespace whirl::linalg {

// Of complex vectors of one size, two entries in one instruction.

/// a^H b
[[nodiscard]] std::complex<double> dot(const Eigen::VectorXcd &a, const Eigen::VectorXcd &b);

/// y += f x
void add_multiple(std::complex<double> f, const Eigen::VectorXcd &x, Eigen::VectorXcd &y);
void add_multiple(double f, const Eigen::VectorXcd &x, Eigen::VectorXcd &y);

} // namespace whirl::linalg
