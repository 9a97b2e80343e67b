#include "balancers/balanced_position.h"
#include "closed_form/balanced_position.h"
#include "model/errors.h"
#include "support/balancer_parts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace {

using namespace whirl;
using std::numbers::pi;

/// Balancer of capacity E with m0 R0 = 0.4, R0 = 0.2; none for infinite E.
model::Balancer balls(int n, double E) {
    model::Balancer balancer;
    tests::row(balancer).n = n;
    tests::row(balancer).radius = 0.2;
    balancer.imbalance = std::isinf(E) ? 0 : 0.4;
    balancer.imbalance_radius = 0.2;
    tests::row(balancer).mass = std::isinf(E) ? 1 : E * 0.4 / (n * 0.2);
    return balancer;
}

/// |sum exp(i a)/n + 1/E|.
double defect(const std::vector<double> &angles, double E) {
    std::complex<double> sum = 0;
    for (const double a : angles)
        sum += std::polar(1.0, a);
    return std::abs(sum / static_cast<double>(angles.size()) + 1 / E);
}

constexpr double infinite = std::numeric_limits<double>::infinity();

// Sums of n cosines of angles that are themselves right to a rounding or two.
TEST(BalancedPosition, every_sample_balances) {
    for (const double E : {1.0, 1.0 + 1e-6, 1.2, 2.0, 7.0, infinite})
        for (int n = 2; n <= 9; ++n) {
            const auto positions = balancers::sampled_positions(balls(n, E), 25);
            ASSERT_FALSE(positions.empty());
            for (const auto &angles : positions) {
                EXPECT_EQ(std::ssize(angles), n);
                EXPECT_LT(defect(angles, E), 1e-12) << "n = " << n << ", E = " << E;
            }
            if (E > 1 && E < 1.1) // D differs next to nothing there, and samples of equal D are one
                continue;
            const bool family = n > 2 && E > 1 && !(n == 3 && std::isinf(E));
            EXPECT_EQ(positions.size(), family ? 25U : 1U) << "n = " << n << ", E = " << E;
        }
}

// The ends of the interval are attained to 1e-12; near E = 1 the whole interval is 1e-13 wide.
TEST(BalancedPosition, samples_lie_inside_the_intervals) {
    for (const double E : {1.0 + 1e-6, 1.2, 2.0, 7.0, infinite})
        for (int n = 3; n <= 7; ++n) {
            SCOPED_TRACE(testing::Message() << "n = " << n << ", E = " << E);
            const model::Balancer balancer = balls(n, E);
            const auto harmonic = balancers::second_harmonic_interval(balancer).value();
            const auto anisotropy = balancers::anisotropy_interval(balancer).value();
            const auto [A_m, A_m0, own] = balancers::added_inertias(balancer);
            for (const auto &angles : balancers::sampled_positions(balancer, 60)) {
                const std::complex<double> D = closed_form::second_harmonic(angles);
                EXPECT_GE(std::abs(D), harmonic.least - 1e-11);
                EXPECT_LE(std::abs(D), harmonic.largest + 1e-11);
                const double a = std::abs(A_m0 + A_m * D) / 2;
                EXPECT_GE(a, anisotropy.least - 1e-11);
                EXPECT_LE(a, anisotropy.largest + 1e-11);
            }
        }
}

TEST(BalancedPosition, samples_spread_over_the_family) {
    // |1 + E D| of three balls at E = 2 covers 0.5 to 1.837117; a hundred samples come within a
    // twentieth of the way of every value between.
    const model::Balancer balancer = balls(3, 2);
    std::vector<double> values;
    for (const auto &angles : balancers::sampled_positions(balancer, 100))
        values.push_back(std::abs(1.0 + 2.0 * closed_form::second_harmonic(angles)));
    for (double wanted = 0.5; wanted < 1.837; wanted += 0.01) {
        double nearest = 1e300;
        for (const double value : values)
            nearest = std::min(nearest, std::abs(value - wanted));
        EXPECT_LT(nearest, 0.067) << wanted;
    }
}

TEST(BalancedPosition, full_capacity_puts_all_balls_opposite_the_imbalance) {
    for (int n = 1; n <= 8; ++n) {
        const auto positions = balancers::sampled_positions(balls(n, 1), 10);
        ASSERT_EQ(positions.size(), 1U);
        // cos a = -1 to a rounding leaves an angle of its square root, D one of its first power.
        EXPECT_NEAR(std::abs(closed_form::second_harmonic(positions[0]) - 1.0), 0, 1e-7);
        EXPECT_NEAR(std::abs(closed_form::second_harmonic(positions[0])), 1, 1e-14);
    }
}

TEST(BalancedPosition, without_imbalance_the_balls_spread_evenly) {
    EXPECT_TRUE(std::isinf(balancers::capacity(balls(3, infinite))));
    const auto two = balancers::angles_at_balance(balls(2, infinite), "balancer[0]");
    EXPECT_NEAR(std::abs(two[0] - two[1]), pi, 1e-15);
    for (int n = 3; n <= 6; ++n) {
        const auto angles = balancers::angles_at_balance(balls(n, infinite), "balancer[0]");
        for (int j = 1; j < n; ++j)
            EXPECT_NEAR(angles[j] - angles[j - 1], 2 * pi / n, 1e-14);
        EXPECT_LT(std::abs(closed_form::second_harmonic(angles)), 1e-15);
    }
    // Two opposite pairs: D = (exp(2 i a) + exp(2 i b))/2.
    const auto four = balancers::second_harmonic_interval(balls(4, infinite)).value();
    EXPECT_NEAR(four.least, 0, 1e-12);
    EXPECT_NEAR(four.largest, 1, 1e-12);
}

TEST(BalancedPosition, two_balls_of_capacity_two_make_the_composite_isotropic) {
    const model::Balancer balancer = balls(2, 2);
    const auto [A_m, A_m0, own] = balancers::added_inertias(balancer);
    EXPECT_DOUBLE_EQ(A_m, 0.16);
    EXPECT_DOUBLE_EQ(A_m0, 0.08);
    const auto D =
        closed_form::second_harmonic(balancers::angles_at_balance(balancer, "balancer[0]"));
    EXPECT_NEAR(std::abs(A_m0 + A_m * D), 0, 1e-16);
}

TEST(BalancedPosition, a_given_position_is_kept) {
    model::Balancer balancer = balls(4, 2);
    balancer.position = {pi, pi, pi / 2, -pi / 2};
    EXPECT_EQ(balancers::angles_at_balance(balancer, "balancer[0]"), balancer.position);
    EXPECT_EQ(balancers::sampled_positions(balancer, 5).front(), balancer.position);
}

std::string message_of(const model::Balancer &balancer) {
    try {
        (void)balancers::angles_at_balance(balancer, "balancer[1]");
    } catch (const model::BadInput &error) {
        return error.what();
    }
    return "";
}

TEST(BalancedPosition, too_little_capacity_is_refused) {
    EXPECT_EQ(message_of(balls(2, 0.5)),
              "balancer[1]: expected a capacity E = n m R/(m0 R0) of at least 1 for a balanced "
              "position, got 0.5");
    EXPECT_FALSE(balancers::second_harmonic_interval(balls(3, 0.5)));
    EXPECT_EQ(message_of(balls(1, 2)), "balancer[1]: expected a capacity E = m R/(m0 R0) of 1 for "
                                       "a balanced position of one ball, got 2");
    EXPECT_NE(message_of(balls(1, infinite)), "");
    model::Balancer pendulum = balls(4, 2);
    pendulum.parts = model::Pendulums{1, 0.1, 0.1, 0};
    EXPECT_NE(message_of(pendulum), "");
}

TEST(BalancedPosition, capacity_below_one_by_rounding_is_one) {
    model::Balancer balancer = balls(3, 1);
    tests::row(balancer).mass *= 1 - 1e-15;
    EXPECT_NEAR(std::abs(closed_form::second_harmonic(
                    balancers::angles_at_balance(balancer, "balancer[0]"))),
                1, 1e-14);
}

} // namespace
