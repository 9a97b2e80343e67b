// The coefficients of the integrator: orders by what they do to differential equations with known
// solutions.

#include "simulation/runge_kutta.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

namespace whirl::simulation::runge_kutta_tests {
namespace {

using Complex = std::complex<double>;

/// One step of both solutions.
template <class Value, class Rates>
std::pair<Value, Value> stepped(const RungeKuttaPair &pair, Value y, double t, double h,
                                const Rates &rates) {
    std::array<Value, RungeKuttaPair::stages> k{};
    Value high = y;
    Value low = y;
    for (std::size_t i = 0; i < k.size(); ++i) {
        Value here = y;
        for (std::size_t j = 0; j < i; ++j)
            here += h * pair.a[i][j] * k[j];
        k[i] = rates(t + pair.c[i] * h, here);
        high += h * pair.b[i] * k[i];
        low += h * pair.embedded_b[i] * k[i];
    }
    return {high, low};
}

TEST(RungeKutta, StagesStandAtTheTimesOfTheirSums) {
    const RungeKuttaPair &pair = verner_pair();
    for (std::size_t i = 0; i < pair.c.size(); ++i) {
        double sum = 0;
        for (const double a : pair.a[i])
            sum += a;
        EXPECT_NEAR(sum, pair.c[i], 1e-13) << i; // of entries up to 123
    }
}

TEST(RungeKutta, PowersOfTimeAreExactUpToTheOrder) {
    const RungeKuttaPair &pair = verner_pair();
    for (int power = 0; power < pair.order; ++power) {
        const auto [high, low] =
            stepped(pair, 0.0, 0.0, 1.0, [power](double t, double) { return std::pow(t, power); });
        EXPECT_NEAR(high, 1.0 / (power + 1), 1e-13) << power; // of weights up to 31
        if (power < pair.embedded)
            EXPECT_NEAR(low, 1.0 / (power + 1), 1e-13) << power;
    }
}

/// Slope of the error over the step, by halving it.
template <class Rates, class Exact>
std::pair<double, double> observed_orders(double h, const Rates &rates, const Exact &exact) {
    const auto errors = [&](double step) {
        const auto [high, low] = stepped(verner_pair(), exact(0.3), 0.3, step, rates);
        return std::pair(std::abs(high - exact(0.3 + step)), std::abs(low - exact(0.3 + step)));
    };
    const auto [high, low] = errors(h);
    const auto [half_high, half_low] = errors(h / 2);
    return {std::log2(high / half_high), std::log2(low / half_low)};
}

// The error of one step is of the order of the method plus one; the next term bends the slope.
TEST(RungeKutta, ErrorsOfNonlinearEquationsHaveTheOrder) {
    const RungeKuttaPair &pair = verner_pair();
    const auto riccati = observed_orders(
        0.3, [](double, double y) { return 1 + y * y; }, [](double t) { return std::tan(t); });
    EXPECT_GT(riccati.first, pair.order + 0.5);
    EXPECT_GT(riccati.second, pair.embedded + 0.5);
    const auto witch = observed_orders(
        0.4, [](double t, double y) { return -2 * t * y * y; },
        [](double t) { return 1 / (1 + t * t); });
    EXPECT_GT(witch.first, pair.order + 0.5);
    EXPECT_GT(witch.second, pair.embedded + 0.5);
}

// Around the steps that tolerances of 1e-6 to 1e-10 ask for.
TEST(RungeKutta, TheEstimateIsLargerThanTheErrorOfAnOscillator) {
    for (const double angle : {0.4, 0.7, 1.0, 1.3}) {
        const auto [high, low] = stepped(verner_pair(), Complex(1), 0.0, angle,
                                         [](double, Complex y) { return Complex(0, 1) * y; });
        const double error = std::abs(high - std::polar(1.0, angle));
        const double estimate = std::abs(high - low);
        EXPECT_GT(estimate, 2 * error) << angle;
        EXPECT_LT(estimate, 20 * error) << angle;
    }
}

} // namespace
} // namespace whirl::simulation::runge_kutta_tests
