#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <complex>

namespace whirl::modes {

/// A free motion exp(l t) sum_k q_k exp(2 i k speed t).
struct SeriesTerms {
    std::complex<double> value; ///< l, 1/s
    Eigen::MatrixXcd terms;     ///< q_-K, ..., q_K, a column each
};

/// At slow speeds the frequency of a motion rises and falls while the rotor turns, and a modulated
/// frequency has terms over a band that is many times the speed wide: their sizes and phases change
/// from speed to speed, while the deflections hardly do. This is the motion without it: divided by
/// a periodic function of time so that its rate l(t) = <u, u'> / <u, u> is the mean one throughout;
/// moved so that this is nearest to the exponent of the term in the middle.
/// @param mass   symmetric, for the products
/// @param speed  not zero, rad/s
[[nodiscard]] SeriesTerms without_modulation(const Eigen::SparseMatrix<double> &mass, double speed,
                                             const SeriesTerms &motion);

} // namespace whirl::modes
