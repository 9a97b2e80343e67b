#include "elements/quadrature.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using whirl::elements::gauss_legendre;

TEST(GaussLegendre, IntegratesPowersOfItsDegreeExactlyAndNotTheNext) {
    for (const int n : {1, 2, 3, 5, 8, 14, 25}) {
        const auto &rule = gauss_legendre(n);
        ASSERT_EQ(rule.points.size(), static_cast<std::size_t>(n));
        const auto integral = [&rule](int power) {
            double sum = 0;
            for (std::size_t q = 0; q < rule.points.size(); ++q)
                sum += rule.weights[q] * std::pow(2 * rule.points[q] - 1, power);
            return sum;
        };
        // int_0^1 (2x - 1)^k dx = 1/(k + 1) for even k, 0 for odd k.
        for (int k = 0; k <= 2 * n - 1; ++k)
            EXPECT_NEAR(integral(k), k % 2 == 0 ? 1.0 / (k + 1) : 0.0, 1e-14) << n << " " << k;
        if (n <= 8) { // beyond, the error of the next power is itself below 1e-5
            EXPECT_GT(std::abs(integral(2 * n) - 1.0 / (2 * n + 1)), 1e-6);
        }
    }
}

TEST(GaussLegendre, ThreePointRuleHasItsTextbookPoints) {
    const auto &rule = gauss_legendre(3);
    EXPECT_NEAR(rule.points[0], (1 - std::sqrt(0.6)) / 2, 1e-15);
    EXPECT_NEAR(rule.points[1], 0.5, 1e-15);
    EXPECT_NEAR(rule.weights[0], 5.0 / 18, 1e-15);
    EXPECT_NEAR(rule.weights[1], 8.0 / 18, 1e-15);
}

} // namespace
