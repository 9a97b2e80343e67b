#include "linalg/dense/products.h"
#include "periodic/half_turn.h"
#include "periodic/monodromy.h"

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

/// The displacements and rates of motions over the period, of each a column for each step; without
/// its growth and turn, so that they repeat.
struct OverPeriod {
    MatrixXcd displacements, rates;

    [[nodiscard]] double frequency(const MatrixXd &M) const {
        const auto square = [&M](const MatrixXcd &x) {
            const MatrixXd real = x.real();
            const MatrixXd imag = x.imag();
            const MatrixXd by_real = linalg::times(M, real);
            const MatrixXd by_imag = linalg::times(M, imag);
            return std::hypot(real.cwiseProduct(by_real).sum() + imag.cwiseProduct(by_imag).sum(),
                              real.cwiseProduct(by_imag).sum() - imag.cwiseProduct(by_real).sum());
        };
        return std::sqrt(square(rates) / std::max(square(displacements), 1e-300));
    }
};

std::vector<OverPeriod> over_period(const std::vector<FloquetMotion> &motions,
                                    const std::vector<Rows> &along, double length) {
    const Eigen::Index n = along.front().rows() / 2;
    const std::ptrdiff_t count = std::ssize(motions);
    Rows start(2 * n, 2 * count);
    Rows now(2 * n, 2 * count);
    for (Eigen::Index i = 0; i < count; ++i)
        start.middleCols(2 * i, 2) << motions[static_cast<std::size_t>(i)].shape.real(),
            motions[static_cast<std::size_t>(i)].shape.imag();
    std::vector<OverPeriod> out(motions.size());
    for (OverPeriod &one : out)
        for (MatrixXcd *x : {&one.displacements, &one.rates})
            x->resize(n, std::ssize(along));
    for (Eigen::Index step = 0; step < std::ssize(along); ++step) {
        linalg::set_product(along[static_cast<std::size_t>(step)], start, now);
        for (Eigen::Index i = 0; i < count; ++i) {
            OverPeriod &one = out[static_cast<std::size_t>(i)];
            const Complex back = std::exp(-motions[static_cast<std::size_t>(i)].value *
                                          (length * static_cast<double>(step)));
            const Eigen::VectorXcd state =
                back * (now.col(2 * i) + Complex(0, 1) * now.col(2 * i + 1));
            one.displacements.col(step) = state.head(n);
            one.rates.col(step) = state.tail(n);
        }
    }
    return out;
}

/// exp(-2 i k speed t) / steps at the beginnings of the steps, a column for each k = -K, ..., K.
MatrixXcd fourier(int steps, int K, bool backwards) {
    MatrixXcd out(steps, 2 * K + 1);
    const double turn = (backwards ? 2 : -2) * std::numbers::pi / steps;
    for (int k = -K; k <= K; ++k)
        for (int step = 0; step < steps; ++step)
            out(step, k + K) = std::polar(1.0 / steps, turn * ((k * step) % steps));
    return out;
}

} // namespace

std::vector<FloquetSeries> floquet_series(const System &system, double speed, int steps,
                                          double fastest) {
    std::vector<Rows> along;
    const MatrixXd turn = half_turn(system, speed, steps, &along);
    const MatrixXd M = system.steady(speed).M;
    const int most = (steps - 1) / 2;
    const MatrixXcd all = fourier(steps, most, speed < 0);
    std::vector<FloquetMotion> motions = motions_of(system, speed, turn);
    std::erase_if(motions, [](const FloquetMotion &motion) { return motion.value.imag() < 0; });
    const std::vector<OverPeriod> all_over = over_period(motions, along, period(speed) / steps);
    std::vector<FloquetSeries> out;
    for (std::size_t i = 0; i < motions.size(); ++i) {
        const FloquetMotion &motion = motions[i];
        const OverPeriod &over = all_over[i];
        const double frequency = over.frequency(M);
        if (frequency > fastest)
            continue;
        constexpr int more = 6;
        constexpr double beyond = 3; // on average over the terms it is as fast as its frequency
        const int K =
            std::min(most, static_cast<int>(beyond * frequency / (2 * std::abs(speed))) + more);
        const MatrixXcd waves = all.middleCols(most - K, 2 * K + 1);
        out.push_back({motion.value, motion.noise,
                       system.scales().asDiagonal() * linalg::times(over.displacements, waves)});
    }
    return out;
}

} // namespace whirl::periodic
