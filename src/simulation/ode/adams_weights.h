#pragma once

#include <Eigen/Core>

#include <vector>

namespace whirl::simulation {

/// Weights of Adams methods for x' = a x + N(t), exact in a: over a step h, with N the polynomial
/// through its last values at equal steps, given by their backward differences D_j,
///     x(t + h) = exp(h a) x(t) + sum_j weight_j D_j,
///     weight_j = h int_0^1 exp((1 - s) h a) s (s + 1) ... (s + j - 1) / j! ds.
/// With a = 0 those of Adams and Bashforth (Hairer, Norsett, Wanner, Solving Ordinary Differential
/// Equations I, III.1; with a: Norsett 1969, Cox and Matthews 2002).
struct AdamsWeights {
    double h = 0;
    Eigen::ArrayXcd growth;  ///< exp(h a), of each a
    Eigen::ArrayXXcd modal;  ///< of each a a row, j = 0, 1, ...
    std::vector<double> own; ///< of a = 0
};

/// @param a      1/s, |h a| <= adams_reach
/// @param count  of weights
/// @param share  < 1: over this share of the step that ended at the last value
[[nodiscard]] AdamsWeights adams_weights(const Eigen::VectorXcd &a, double h, int count,
                                         double share = 1);

/// Beyond it the quadrature of the weights does not hold its fourteen digits.
constexpr double adams_reach = 30;

/// The matrix T with D' = D T: the differences of the same polynomial (degree `count` - 1) at steps
/// `ratio` times as long, by 1 - (1 - D)^ratio.
[[nodiscard]] Eigen::MatrixXd rescaled_differences(double ratio, int count);

} // namespace whirl::simulation
