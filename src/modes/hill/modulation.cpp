#include "modes/hill/modulation.h"

#include "linalg/dense/products.h"

#include <cmath>
#include <numbers>

namespace whirl::modes {

namespace {

using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::VectorXcd;

/// exp(2 i k angle) at even angles of half a turn: a row for each k = -K, ..., K.
MatrixXcd waves(Index K, Index samples) {
    MatrixXcd out(2 * K + 1, samples);
    const double turn = 2 * std::numbers::pi / static_cast<double>(samples);
    for (Index k = -K; k <= K; ++k)
        for (Index j = 0; j < samples; ++j)
            out(k + K, j) = std::polar(1.0, turn * static_cast<double>((k * j) % samples));
    return out;
}

} // namespace

SeriesTerms without_modulation(const Eigen::SparseMatrix<double> &mass, double speed,
                               const SeriesTerms &motion) {
    const Index K = motion.terms.cols() / 2;
    constexpr Index more = 8; // terms of what the motion is divided by
    const Index samples = 4 * (K + more);
    const MatrixXcd over = waves(K, samples);
    VectorXcd exponents(2 * K + 1);
    for (Index k = -K; k <= K; ++k)
        exponents(k + K) = motion.value + Complex(0, 2 * speed * static_cast<double>(k));
    const MatrixXcd u = linalg::times(motion.terms, over);
    const MatrixXcd rates = motion.terms * exponents.asDiagonal();
    const MatrixXcd rate = linalg::times(rates, over);
    const MatrixXcd weighted = mass * u;
    const VectorXcd l =
        (weighted.conjugate().cwiseProduct(rate)).colwise().sum().transpose().array() /
        (weighted.conjugate().cwiseProduct(u)).colwise().sum().transpose().array();
    if (!l.allFinite())
        return motion;
    const Index wide = samples / 2 - 1;
    const MatrixXcd all = waves(wide, samples);
    VectorXcd parts = linalg::times(MatrixXcd(all.conjugate()), l) / static_cast<double>(samples);
    const Complex mean = parts(wide);
    parts(wide) = 0;
    for (Index m = -wide; m <= wide; ++m)
        if (m != 0)
            parts(m + wide) /= Complex(0, 2 * speed * static_cast<double>(m));
    const VectorXcd logarithm = linalg::times(MatrixXcd(all.transpose()), parts);
    const auto places = static_cast<Index>(std::lround((mean - motion.value).imag() / (2 * speed)));
    SeriesTerms out;
    out.value = motion.value + Complex(0, 2 * speed * static_cast<double>(places));
    const VectorXcd divided = (-logarithm.array()).exp();
    const MatrixXcd repeating = u * divided.asDiagonal() / static_cast<double>(samples);
    const MatrixXcd spectrum = linalg::times(repeating, MatrixXcd(all.adjoint()));
    out.terms = MatrixXcd::Zero(u.rows(), 2 * K + 1);
    for (Index k = -K; k <= K; ++k)
        if (std::abs(k + places) <= wide)
            out.terms.col(k + K) = spectrum.col(k + places + wide);
    return out;
}

} // namespace whirl::modes
