#include "closed_form/arrangement_interval.h"

#include "closed_form/balanced_position.h"
#include "closed_form/two_balls.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <numbers>
#include <optional>
#include <random>

namespace whirl::closed_form {
namespace {

/// Half a unit of the sixth, or fourth, printed decimal.
constexpr double six_decimals = 0.5e-6;
constexpr double four_decimals = 0.5e-4;

/// Interval of D_A = |D|.
std::optional<ArrangementInterval> second_harmonic_interval(int balls, double capacity) {
    return modulus_interval(balls, capacity, 0.0, 1.0);
}

/// Distance from balance |(1/n) sum exp(i a_j) + 1/E|, zero in a balanced position.
double balance_defect(const std::vector<double> &angles, double capacity) {
    std::complex<double> sum = 0.0;
    for (const double angle : angles)
        sum += std::polar(1.0, angle);
    return std::abs(sum / static_cast<double>(angles.size()) + 1.0 / capacity);
}

/// A random balanced position: random angles, moved to balance by minimum-norm Newton steps.
bool random_position(std::mt19937 &generator, double capacity, std::vector<double> &angles) {
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const double spread = std::numbers::pi * unit(generator);
    for (double &angle : angles)
        angle = std::numbers::pi + spread * (2.0 * unit(generator) - 1.0);
    const auto n = static_cast<Eigen::Index>(angles.size());
    for (int iteration = 0; iteration < 12; ++iteration) {
        Eigen::Vector2d residual(1.0 / capacity, 0.0);
        Eigen::Matrix2Xd jacobian(2, n);
        for (Eigen::Index j = 0; j < n; ++j) {
            residual += Eigen::Vector2d(std::cos(angles[j]), std::sin(angles[j])) / n;
            jacobian.col(j) = Eigen::Vector2d(-std::sin(angles[j]), std::cos(angles[j])) / n;
        }
        if (residual.norm() < 1e-14)
            return true;
        const Eigen::Matrix2d gram = jacobian * jacobian.transpose();
        const Eigen::VectorXd step = jacobian.transpose() * gram.inverse() * residual;
        for (Eigen::Index j = 0; j < n; ++j)
            angles[j] -= step[j];
    }
    return false;
}

/// D of three balls lies on the arc 3/E^2 + (2/E) exp(i psi) (self-inversive cubic); its ends are
/// the positions with two balls together, whose angle solves 2 cos a + cos b = -3/E, 2 sin a + sin
/// b = 0.
std::array<double, 2> three_ball_interval(double E, double constant, double factor) {
    double least = 1e300;
    double largest = 0.0;
    for (int i = 0; i <= 400000; ++i) {
        const double psi = 2.0 * std::numbers::pi * i / 400000;
        const std::complex<double> e3 = std::polar(1.0, psi);
        // Roots of x^3 - e1 x^2 + e2 x - e3 on the unit circle: Cohn's condition through the
        // derivative, both roots of 3 x^2 - 2 e1 x + e2 in the closed unit disc.
        const double e1 = -3.0 / E;
        const std::complex<double> e2 = e1 * e3;
        const std::complex<double> root = std::sqrt(e1 * e1 - 3.0 * e2);
        if (std::max(std::abs(e1 + root), std::abs(e1 - root)) > 3.0 * (1.0 + 1e-9))
            continue;
        const double value = std::abs(constant + factor * (e1 * e1 - 2.0 * e2) / 3.0);
        least = std::min(least, value);
        largest = std::max(largest, value);
    }
    return {least, largest};
}

TEST(ArrangementInterval, TwoBallsHaveOnePosition) {
    const double capacities[] = {1.2, 1.5, 3.0};
    const double harmonics[] = {0.388889, 0.111111, 0.777778};
    const double moduli[] = {1.466667, 0.833333, 1.333333};
    for (int i = 0; i < 3; ++i) {
        const double E = capacities[i];
        const auto harmonic = second_harmonic_interval(2, E).value();
        EXPECT_NEAR(harmonic.least, harmonics[i], six_decimals);
        EXPECT_NEAR(harmonic.largest, harmonics[i], six_decimals);
        EXPECT_NEAR(harmonic.least, std::abs(two_ball_second_harmonic(E)), 1e-14);
        const auto sum = modulus_interval(2, E, 1.0, E).value();
        EXPECT_NEAR(sum.least, moduli[i], six_decimals);
        EXPECT_NEAR(sum.largest, moduli[i], six_decimals);
    }
}

struct Row {
    int balls;
    double capacity;
    std::array<double, 2> harmonic;
    std::array<double, 2> sum;
    double tolerance;
};

// Three balls: exact to the digits shown. More: two million random balanced positions, whose
// extremes lie inside the true ones by some units of the last digit.
TEST(ArrangementInterval, Table) {
    const Row rows[] = {
        {3, 1.2, {0.416667, 0.444878}, {1.5, 1.516245}, six_decimals},
        {3, 1.5, {0.0, 0.408248}, {1.0, 1.25}, six_decimals},
        {3, 2.0, {0.25, 0.728869}, {0.5, 1.837117}, six_decimals},
        {3, 6.0, {0.25, 0.416667}, {0.5, 3.5}, six_decimals},
        {4, 1.2, {0.3889, 0.5251}, {1.4667, 1.5955}, four_decimals},
        {4, 2.0, {0.0, 1.0}, {0.0, 3.0}, four_decimals},
        {5, 2.0, {0.0, 0.6748}, {0.25, 2.337581}, four_decimals},
    };
    for (const Row &row : rows) {
        SCOPED_TRACE(testing::Message() << "n = " << row.balls << ", E = " << row.capacity);
        const auto harmonic = second_harmonic_interval(row.balls, row.capacity).value();
        EXPECT_NEAR(harmonic.least, row.harmonic[0], row.tolerance);
        EXPECT_NEAR(harmonic.largest, row.harmonic[1], row.tolerance);
        const auto sum = modulus_interval(row.balls, row.capacity, 1.0, row.capacity).value();
        EXPECT_NEAR(sum.least, row.sum[0], row.tolerance);
        EXPECT_NEAR(sum.largest, row.sum[1], row.tolerance);
    }
}

TEST(ArrangementInterval, FullCapacityLeavesOnePosition) {
    for (int n = 2; n <= 9; ++n) {
        const auto interval = second_harmonic_interval(n, 1.0).value();
        EXPECT_NEAR(interval.least, 1.0, 1e-12);
        EXPECT_NEAR(interval.largest, 1.0, 1e-12);
    }
}

TEST(ArrangementInterval, ThreeBallsAgreeWithTheCubic) {
    for (const double E : {1.1, 1.37, 1.8, 2.5, 3.0, 4.0, 9.0}) {
        for (const double factor : {1.0, 0.6, -1.3}) {
            const auto exact = three_ball_interval(E, 0.7, factor);
            const auto interval = modulus_interval(3, E, 0.7, factor).value();
            // Grid of the reference: 1.6e-5 rad along an arc of radius up to 2.
            EXPECT_NEAR(interval.least, exact[0], 5e-5) << E << ' ' << factor;
            EXPECT_NEAR(interval.largest, exact[1], 5e-5) << E << ' ' << factor;
        }
    }
}

TEST(ArrangementInterval, EndsAreAttainedByBalancedPositions) {
    for (int n = 3; n <= 9; ++n) {
        for (const double E : {1.05, 1.6, 2.3, 5.0}) {
            const auto interval = modulus_interval(n, E, 1.0, 1.4).value();
            for (const bool largest : {false, true}) {
                const auto &angles = largest ? interval.largest_position : interval.least_position;
                ASSERT_EQ(angles.size(), static_cast<std::size_t>(n));
                EXPECT_LT(balance_defect(angles, E), 1e-12);
                EXPECT_NEAR(std::abs(1.0 + 1.4 * second_harmonic(angles)),
                            largest ? interval.largest : interval.least, 1e-12);
            }
        }
    }
}

// 250 000 random balanced positions, three intervals each: none may lie outside.
TEST(ArrangementInterval, ContainsEverySampledPosition) {
    std::mt19937 generator(11);
    for (int n = 3; n <= 7; ++n) {
        for (const double E : {1.15, 1.5, 2.0, 3.0, 8.0}) {
            const auto harmonic = second_harmonic_interval(n, E).value();
            const auto sum = modulus_interval(n, E, 1.0, E).value();
            const auto other = modulus_interval(n, E, 0.3, -0.8).value();
            std::vector<double> angles(n);
            int samples = 0;
            int outside = 0;
            for (int i = 0; i < 100000 && samples < 10000; ++i) {
                if (!random_position(generator, E, angles))
                    continue;
                ++samples;
                const auto D = second_harmonic(angles);
                const auto misses = [](const ArrangementInterval &interval, double value) {
                    return value < interval.least - 1e-11 || value > interval.largest + 1e-11;
                };
                outside += misses(harmonic, std::abs(D)) || misses(sum, std::abs(1.0 + E * D)) ||
                           misses(other, std::abs(0.3 - 0.8 * D));
            }
            EXPECT_EQ(samples, 10000);
            EXPECT_EQ(outside, 0) << n << ' ' << E;
        }
    }
}

TEST(ArrangementInterval, RefusesWhatCannotBalance) {
    EXPECT_FALSE(second_harmonic_interval(3, 0.99));
    EXPECT_FALSE(second_harmonic_interval(1, 2.0));
    EXPECT_FALSE(symmetric_position(4, 0.5));
    EXPECT_FALSE(symmetric_position(1, 1.0));
}

TEST(BalancedPosition, SymmetricPositionsBalance) {
    for (int n = 2; n <= 9; ++n) {
        for (const double E : {1.0, 1.01, 1.9, 3.0, 50.0}) {
            const auto angles = symmetric_position(n, E).value();
            ASSERT_EQ(angles.size(), static_cast<std::size_t>(n));
            EXPECT_LT(balance_defect(angles, E), 1e-15) << n << ' ' << E;
            EXPECT_NEAR(second_harmonic(angles).imag(), 0.0, 1e-15);
        }
    }
    EXPECT_NEAR(second_harmonic(symmetric_position(2, 1.5).value()).real(),
                two_ball_second_harmonic(1.5), 1e-15);
}

} // namespace
} // namespace whirl::closed_form
