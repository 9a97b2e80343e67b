#pragma once

#include <Eigen/Core>

#include <complex>

namespace whirl::periodic {

/// exp(-2 i k speed t) / steps at the beginnings of the steps, a column for each k = from, ..., to.
[[nodiscard]] Eigen::MatrixXcd fourier(Eigen::Index steps, Eigen::Index from, Eigen::Index to,
                                       bool backwards);

/// Number of the term that the motion turns with on average over the period.
/// @param states  (q, q'), a column for each step, without growth and turn
[[nodiscard]] Eigen::Index mean_term(const Eigen::MatrixXd &M, const Eigen::MatrixXcd &states,
                                     std::complex<double> value, double speed);

} // namespace whirl::periodic
