#include "linalg/dense/products.h"
#include "periodic/fourier.h"
#include "periodic/half_turn.h"
#include "periodic/monodromy.h"
#include "periodic/step_maps.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace whirl::periodic {

namespace {

using Complex = std::complex<double>;
using Eigen::MatrixXcd;
using Eigen::MatrixXd;
using linalg::Rows;

/// (q, q') of motions over the period, of each a column for each step; without its growth and turn,
/// so that they repeat.
std::vector<MatrixXcd> over_period(const std::vector<FloquetMotion> &motions,
                                   const std::vector<Rows> &along, double length) {
    const Eigen::Index rows = along.front().rows();
    const std::ptrdiff_t count = std::ssize(motions);
    Rows start(rows, 2 * count);
    Rows now(rows, 2 * count);
    for (Eigen::Index i = 0; i < count; ++i)
        start.middleCols(2 * i, 2) << motions[static_cast<std::size_t>(i)].shape.real(),
            motions[static_cast<std::size_t>(i)].shape.imag();
    std::vector<MatrixXcd> out(motions.size(), MatrixXcd(rows, std::ssize(along)));
    for (Eigen::Index step = 0; step < std::ssize(along); ++step) {
        now.noalias() = along[static_cast<std::size_t>(step)] * start;
        for (Eigen::Index i = 0; i < count; ++i) {
            const Complex back = std::exp(-motions[static_cast<std::size_t>(i)].value *
                                          (length * static_cast<double>(step)));
            out[static_cast<std::size_t>(i)].col(step) =
                back * (now.col(2 * i) + Complex(0, 1) * now.col(2 * i + 1));
        }
    }
    return out;
}

/// The same of one motion, by steps of its own.
MatrixXcd over_period(const System &system, double speed, int steps, const FloquetMotion &motion) {
    const double length = period(speed) / steps;
    const StepMaps maps(system, speed, length);
    const Complex back = std::exp(-motion.value * length);
    MatrixXcd out(2 * system.size(), steps);
    Rows state(2 * system.size(), 2); // real and imaginary parts
    Rows next = state;
    out.col(0) = motion.shape;
    for (int step = 0; step + 1 < steps; ++step) {
        state << out.col(step).real(), out.col(step).imag();
        maps.set_end(step * length, state, next);
        out.col(step + 1) = back * (next.col(0) + Complex(0, 1) * next.col(1));
    }
    return out;
}

} // namespace

MatrixXcd fourier(Eigen::Index steps, Eigen::Index from, Eigen::Index to, bool backwards) {
    Eigen::VectorXcd circle(steps);
    for (Eigen::Index j = 0; j < steps; ++j)
        circle(j) = std::polar(1.0 / static_cast<double>(steps),
                               (backwards ? 2 : -2) * std::numbers::pi * static_cast<double>(j) /
                                   static_cast<double>(steps));
    MatrixXcd out(steps, to - from + 1);
    for (Eigen::Index k = from; k <= to; ++k)
        for (Eigen::Index j = 0; j < steps; ++j)
            out(j, k - from) = circle(((k * j) % steps + steps) % steps);
    return out;
}

Eigen::Index mean_term(const MatrixXd &M, const MatrixXcd &states, Complex value, double speed) {
    const Eigen::Index n = M.rows();
    const MatrixXcd q = states.topRows(n);
    const MatrixXcd weighted = linalg::times(M.cast<Complex>().eval(), q);
    const MatrixXcd rates = states.bottomRows(n);
    const Complex mean =
        weighted.conjugate().cwiseProduct(rates).sum() / weighted.conjugate().cwiseProduct(q).sum();
    return static_cast<Eigen::Index>(std::lround((mean - value).imag() / (2 * speed)));
}

double frequency_of(const MatrixXd &M, const MatrixXcd &states) {
    const auto square = [&M](const MatrixXcd &x) {
        const MatrixXd real = x.real();
        const MatrixXd imag = x.imag();
        const MatrixXd by_real = linalg::times(M, real);
        const MatrixXd by_imag = linalg::times(M, imag);
        return std::hypot(real.cwiseProduct(by_real).sum() + imag.cwiseProduct(by_imag).sum(),
                          real.cwiseProduct(by_imag).sum() - imag.cwiseProduct(by_real).sum());
    };
    const Eigen::Index n = M.rows();
    return std::sqrt(square(states.bottomRows(n)) / std::max(square(states.topRows(n)), 1e-300));
}

std::vector<FloquetSeries> floquet_series(const System &system, double speed, int steps,
                                          double fastest) {
    std::vector<Rows> along;
    const MatrixXd turn = monodromy(system, speed, steps, &along);
    const MatrixXd M = system.steady(speed).M;
    const int most = (steps - 1) / 2;
    const MatrixXcd all = fourier(steps, -most, most, speed < 0);
    std::vector<FloquetMotion> motions = motions_of(system, speed, turn);
    std::erase_if(motions, [](const FloquetMotion &motion) { return motion.value.imag() < 0; });
    const std::vector<MatrixXcd> states = over_period(motions, along, period(speed) / steps);
    std::vector<FloquetSeries> out;
    for (std::size_t i = 0; i < motions.size(); ++i) {
        const FloquetMotion &motion = motions[i];
        const double frequency = frequency_of(M, states[i]);
        if (frequency > fastest)
            continue;
        constexpr int more = 6;      // terms for the tail beyond the highest frequency
        constexpr double beyond = 3; // on average over the terms it is as fast as its frequency
        const int K =
            std::min(most, static_cast<int>(beyond * frequency / (2 * std::abs(speed))) + more);
        const MatrixXcd waves = all.middleCols(most - K, 2 * K + 1);
        const MatrixXcd displacements = states[i].topRows(M.rows());
        out.push_back({motion.value, motion.noise,
                       system.scales().asDiagonal() * linalg::times(displacements, waves)});
    }
    return out;
}

std::optional<FloquetSeries> centred_series(const System &system, double speed, int steps,
                                            const FloquetMotion &motion) {
    constexpr double nothing = 1e-10;  // of the largest term: the value is off by the square, 1e-20
    constexpr Eigen::Index first = 12; // terms on either side, doubled until the ends are nothing
    // Terms on either side at most, and no more than the steps in time resolve.
    constexpr Eigen::Index most = 400;
    const MatrixXcd states = over_period(system, speed, steps, motion);
    if (!states.allFinite())
        return std::nullopt;
    const Eigen::Index middle = mean_term(system.steady(speed).M, states, motion.value, speed);
    const MatrixXcd q = states.topRows(system.size());
    for (Eigen::Index K = first; K <= std::min<Eigen::Index>(most, (steps - 1) / 2); K *= 2) {
        const MatrixXcd terms = linalg::times(q, fourier(steps, middle - K, middle + K, speed < 0));
        const Eigen::VectorXd sizes = terms.colwise().norm();
        Eigen::Index largest = 0;
        const double size = sizes.maxCoeff(&largest);
        const Eigen::Index wide = std::min(largest, 2 * K - largest);
        Eigen::Index kept = 2;
        for (Eigen::Index k = 0; k <= 2 * K; ++k)
            if (sizes(k) > nothing * size)
                kept = std::max(kept, std::abs(k - largest));
        if (kept >= wide)
            continue;
        const double places = static_cast<double>(middle + largest - K);
        return FloquetSeries{motion.value + Complex(0, 2 * speed * places), motion.noise,
                             system.scales().asDiagonal() *
                                 terms.middleCols(largest - kept, 2 * kept + 1)};
    }
    return std::nullopt;
}

} // namespace whirl::periodic
