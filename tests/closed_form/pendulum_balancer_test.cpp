#include "closed_form/pendulum_balancer.h"

#include "closed_form/pendulum_branches.h"
#include "closed_form/pendulum_small_motions.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace whirl::closed_form::pendulum_balancer_test {
namespace {

/// The rotor of the paper's first curve: M = 5 kg, m = 1 kg, l = 18 cm, a = 2 cm.
PendulumRotor figure_rotor(double H = 0.0, double h = 0.0, std::complex<double> imbalance = 0.0) {
    auto rotor = pendulum_rotor(5.0, 1.0, 0.18, 0.02);
    rotor.external_damping = H;
    rotor.hinge_damping = h;
    rotor.imbalance = imbalance;
    return rotor;
}

/// Residual of the steady equations as printed in the paper, in (xi, eta, phi, psi).
double residual(const PendulumRotor &r, double R, const PendulumMotion &m) {
    const double xi = m.position.real();
    const double eta = m.position.imag();
    const double f = r.mass_ratio * R * R;
    const double H = r.external_damping;
    const double first =
        (1.0 - R * R) * xi - R * H * eta + f * std::sin(m.psi) - f * r.imbalance.real();
    const double second =
        R * H * xi + (1.0 - R * R) * eta - f * std::sin(m.phi) - f * r.imbalance.imag();
    const double third = r.pivot_ratio * std::tan(m.phi) - eta;
    const double fourth = r.pivot_ratio * std::tan(m.psi) + xi;
    return std::max({std::abs(first), std::abs(second), std::abs(third), std::abs(fourth)});
}

TEST(PendulumBalancer, EffectivenessOfTheFigures) {
    EXPECT_NEAR(pendulum_rotor(5.0, 1.0, 0.18, 0.02).effectiveness(), 2.0, 1e-14);
    EXPECT_NEAR(pendulum_rotor(5.0, 1.0, 0.15, 0.025).effectiveness(), 4.0 / 3.0, 1e-14);
    EXPECT_NEAR(pendulum_rotor(5.0, 1.0, 0.12, 0.03).effectiveness(), 8.0 / 9.0, 1e-14);
}

TEST(PendulumBalancer, ApproximateEfficiency) {
    const auto rotor = figure_rotor();
    EXPECT_DOUBLE_EQ(efficiency_threshold(rotor), 1.0 / std::sqrt(2.0));
    EXPECT_DOUBLE_EQ(efficiency_limit(rotor), 1.0 / 3.0);
    EXPECT_DOUBLE_EQ(balancer_resonance(rotor), 1.0 / std::sqrt(3.0));
    for (const double H : {0.0, 0.3, 0.6, 1.0}) {
        const auto damped = figure_rotor(H);
        // Both moduli are equal at the threshold, whatever the damping.
        EXPECT_NEAR(approximate_efficiency(damped, efficiency_threshold(damped)), 1.0, 1e-14);
        EXPECT_NEAR(approximate_efficiency(damped, 1e5), 1.0 / 3.0, 1e-9);
        EXPECT_GT(approximate_efficiency(damped, 0.99 * efficiency_threshold(damped)), 1.0);
        EXPECT_LT(approximate_efficiency(damped, 1.01 * efficiency_threshold(damped)), 1.0);
    }
    EXPECT_EQ(approximate_efficiency(rotor, 1.0), 0.0);
    EXPECT_GT(approximate_efficiency(rotor, balancer_resonance(rotor)), 1e12);
}

TEST(PendulumBalancer, SteadyMotionsSatisfyThePrintedEquations) {
    std::mt19937 generator(23);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    int several = 0;
    for (int i = 0; i < 300; ++i) {
        const double R = 0.2 + 2.0 * unit(generator);
        const auto rotor = figure_rotor(i % 3 == 0 ? 0.0 : 0.5 * unit(generator), 0.1,
                                        {0.4 * unit(generator), 0.4 * unit(generator)});
        const auto motions = steady_motions(rotor, R);
        ASSERT_FALSE(motions.empty()) << R;
        several += motions.size() > 1 ? 1 : 0;
        for (const auto &motion : motions)
            EXPECT_LT(residual(rotor, R, motion), 1e-12 * (1.0 + std::abs(motion.position)));
    }
    EXPECT_GT(several, 20);
}

// Without damping the axes separate: three roots each between the fold speeds, nine motions.
TEST(PendulumBalancer, EveryMotionIsFound) {
    const auto rotor = figure_rotor(0.0, 0.0, {0.01, 0.02});
    EXPECT_EQ(steady_motions(rotor, 0.3).size(), 1U);
    EXPECT_EQ(steady_motions(rotor, 0.9).size(), 9U);
    EXPECT_EQ(steady_motions(rotor, 1.5).size(), 1U);
}

TEST(PendulumBalancer, SmallImbalanceReachesTheApproximateEfficiency) {
    for (const double R : {0.4, 1.3, 2.0}) {
        const auto rotor = figure_rotor(0.3, 0.05, {1e-4, 5e-5});
        const auto motions = steady_motions(rotor, R);
        // sin - tan = -phi^3/2 with phi of some 1e-3: relative 1e-6.
        EXPECT_NEAR(exact_efficiency(rotor, motions.front(), R) / approximate_efficiency(rotor, R),
                    1.0, 1e-5);
        EXPECT_TRUE(valid(motions.front()));
    }
}

TEST(PendulumBalancer, LargeImbalanceLeavesTheValidRange) {
    // The pendulums must turn far to make up for an imbalance larger than their own moment.
    const auto rotor = figure_rotor(0.3, 0.5, {1.5, 0.0});
    const auto motion = steady_motions(rotor, 3.0).front();
    EXPECT_FALSE(valid(motion));
    EXPECT_GT(motion.psi, 0.25 * 3.14);
    EXPECT_TRUE(valid(steady_motions(figure_rotor(0.3, 0.5, {0.3, 0.0}), 3.0).front()));
}

TEST(PendulumBalancer, PolynomialIsTheProductOfItsFactors) {
    using namespace std::complex_literals;
    const auto rotor = figure_rotor(0.37, 0.21);
    const double R = 1.43;
    const auto a = pendulum_polynomial(rotor, R);
    for (const std::complex<double> l :
         {0.3 + 0.2i, -1.1 + 0.7i, 2.0 - 1.0i, 0.1 - 3.0i, 1.0 + 0i}) {
        const auto mu = (l + 1i * R) * (l + 1i * R);
        const auto direct =
            (mu + 0.37 * (l + 1i * R) + 1.0) * (l * l + 0.21 * l + rotor.pivot_ratio * R * R) -
            rotor.mass_ratio * mu * mu;
        std::complex<double> horner = 0.0;
        for (const auto coefficient : a)
            horner = horner * l + coefficient;
        EXPECT_LT(std::abs(horner - direct), 1e-12 * (1.0 + std::abs(direct)));
    }
}

// The linearisation about a general motion, at the trivial one, against the polynomial.
TEST(PendulumBalancer, StabilityOfTheTrivialMotionFollowsThePolynomial) {
    for (const double R : {0.4, 0.8, 1.2, 2.0, 3.0}) {
        for (const double H : {0.1, 0.3, 1.0}) {
            const auto rotor = figure_rotor(H, 0.5);
            const auto motions = steady_motions(rotor, R);
            const auto trivial = std::ranges::min_element(
                motions, {}, [](const auto &m) { return std::abs(m.position); });
            ASSERT_LT(std::abs(trivial->position), 1e-12);
            EXPECT_NEAR(trivial->growth, small_motion_growth(rotor, R), 1e-8);
        }
    }
}

// Ends printed with two decimals.
TEST(PendulumBalancer, UnstableRangesOfTheFirstFigure) {
    const auto undamped = unstable_speed_ratios(figure_rotor(), 0.05, 8.0);
    ASSERT_EQ(undamped.size(), 1U);
    EXPECT_NEAR(undamped[0].from, 0.72, 0.5e-2);
    EXPECT_NEAR(undamped[0].to.value(), 2.52, 0.5e-2);

    const auto light = unstable_speed_ratios(figure_rotor(0.3, 0.05), 0.05, 8.0);
    ASSERT_EQ(light.size(), 1U);
    EXPECT_NEAR(light[0].from, 0.74, 0.5e-2);
    EXPECT_EQ(light[0].to, 8.0);

    const auto damped = unstable_speed_ratios(figure_rotor(0.3, 0.5), 0.05, 8.0);
    ASSERT_EQ(damped.size(), 1U);
    EXPECT_NEAR(damped[0].from, 0.63, 0.5e-2);
    EXPECT_NEAR(damped[0].to.value(), 2.27, 0.5e-2);

    EXPECT_TRUE(unstable_speed_ratios(figure_rotor(1.0, 0.5), 0.05, 8.0).empty());
    EXPECT_TRUE(unstable_speed_ratios(figure_rotor(1.0, 0.9), 0.05, 8.0).empty());
}

// The formula promises a small residual where the motion does not settle.
TEST(PendulumBalancer, EfficientButUnstable) {
    const auto rotor = figure_rotor(0.3, 0.05, {0.001, 0.0});
    EXPECT_LT(approximate_efficiency(rotor, 1.2), 0.3);
    for (const auto &motion : steady_motions(rotor, 1.2))
        EXPECT_FALSE(motion.stable && valid(motion));
}

TEST(PendulumBalancer, BranchAgreesWithTheMotionsAtItsSpeeds) {
    const auto rotor = figure_rotor(0.3, 0.05, {0.05, 0.02});
    const auto branch = steady_branch(rotor, 0.1, 2.5);
    ASSERT_GT(branch.size(), 50U);
    EXPECT_GT(branch.back().speed_ratio, 2.3);
    for (std::size_t i = 0; i < branch.size(); i += 7) {
        const auto motions = steady_motions(rotor, branch[i].speed_ratio);
        double nearest = std::numeric_limits<double>::infinity();
        for (const auto &motion : motions)
            nearest = std::min(nearest, std::abs(motion.position - branch[i].motion.position));
        EXPECT_LT(nearest, 1e-8) << branch[i].speed_ratio;
    }
}

// Without damping the motion reached from rest is never the well balanced one between 1/sqrt(1 +
// rho) and 1.
TEST(PendulumBalancer, UndampedBranchFromRestGoesToLargeDeflections) {
    for (const double imbalance : {0.001, 0.05}) {
        const auto rotor = figure_rotor(0.0, 0.0, imbalance);
        const auto branch = steady_branch(rotor, 0.1, 2.5);
        EXPECT_LT(branch.back().speed_ratio, 1.0);
        EXPECT_GT(std::abs(branch.back().motion.position), 9.0);
        EXPECT_FALSE(valid(branch.back().motion));
        // The balanced motion of 1.5, followed down, passes the resonance on its own branch.
        const BranchPoint fast{1.5, steady_motions(rotor, 1.5).front()};
        const auto down = steady_branch(rotor, fast, -1.0, 0.1, 2.5);
        const auto at_resonance =
            std::ranges::find_if(down, [](const auto &point) { return point.speed_ratio < 1.0; });
        ASSERT_NE(at_resonance, down.end());
        EXPECT_LT(exact_efficiency(rotor, at_resonance->motion, at_resonance->speed_ratio), 0.1);
    }
}

// A fold: under damping and a large imbalance the branch from rest turns back and comes up again.
TEST(PendulumBalancer, BranchIsFollowedRoundItsFolds) {
    const auto branch = steady_branch(figure_rotor(0.3, 0.5, 0.3), 0.1, 2.5);
    EXPECT_GT(branch.back().speed_ratio, 2.4);
    const auto turned =
        std::ranges::adjacent_find(branch, [](const auto &first, const auto &second) {
            return second.speed_ratio < first.speed_ratio;
        });
    EXPECT_NE(turned, branch.end());
    EXPECT_EQ(steady_motions(figure_rotor(0.3, 0.5, 0.3), 0.75).size(), 3U);
}

} // namespace
} // namespace whirl::closed_form::pendulum_balancer_test
