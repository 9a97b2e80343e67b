#pragma once

#include <Eigen/Core>
#include <complex>

namespace whirl::closed_form::detail {

/// Adds multiplication of the planar unknown `column` (x + i y) by `factor` to the real equations
/// `row`.
inline void add(Eigen::MatrixXd &matrix, int row, int column, std::complex<double> factor) {
    Eigen::Matrix2d block;
    block << factor.real(), -factor.imag(), factor.imag(), factor.real();
    matrix.block<2, 2>(2 * row, 2 * column) += block;
}

/// Adds factor * conj(unknown).
inline void add_conjugate(Eigen::MatrixXd &matrix, int row, int column,
                          std::complex<double> factor) {
    Eigen::Matrix2d block;
    block << factor.real(), factor.imag(), factor.imag(), -factor.real();
    matrix.block<2, 2>(2 * row, 2 * column) += block;
}

} // namespace whirl::closed_form::detail
