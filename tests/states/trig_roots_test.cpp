// All common roots of trigonometric polynomials, against roots that are known beforehand.

#include "linalg/check.h"
#include "states/trig_roots.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace whirl::states {
namespace {

using std::numbers::pi;
using Function = std::function<Eigen::VectorXd(const Eigen::VectorXd &)>;

TrigRoots roots_of_function(const Eigen::VectorXi &degrees, const Function &f) {
    return all_roots(interpolated(degrees, Eigen::VectorXd::Ones(degrees.size()), f));
}

TEST(TrigRoots, OfOneAngleAreThoseOfItsFactors) {
    // Products of sin((x - a)/2) over an even number of angles a.
    std::mt19937 random(7);
    std::uniform_real_distribution<double> angle(0, 2 * pi);
    int runs = 0;
    int decided = 0;
    for (int run = 0; run < 200; ++run) {
        std::vector<double> zeros(8);
        for (double &zero : zeros)
            zero = angle(random);
        std::ranges::sort(zeros);
        double closest = zeros.front() + 2 * pi - zeros.back();
        for (std::size_t i = 1; i < zeros.size(); ++i)
            closest = std::min(closest, zeros[i] - zeros[i - 1]);
        if (closest < 1e-3)
            continue;
        const TrigRoots found =
            roots_of_function(Eigen::VectorXi::Constant(1, 4), [&](const Eigen::VectorXd &x) {
                double product = 1;
                for (const double zero : zeros)
                    product *= std::sin((x(0) - zero) / 2);
                return Eigen::VectorXd::Constant(1, product).eval();
            });
        // Of eight roots some are so close that rounding hides them: then that is said.
        const auto is_near = [](const std::vector<Eigen::VectorXd> &all, double at, double within) {
            return std::ranges::any_of(all, [&](const Eigen::VectorXd &one) {
                return std::abs(std::remainder(one(0) - at, 2 * pi)) < within;
            });
        };
        for (const double zero : zeros)
            EXPECT_TRUE(is_near(found.roots, zero, 1e-6) || is_near(found.undecided, zero, 1e-4))
                << zero;
        EXPECT_LE(found.roots.size(), zeros.size());
        decided += found.roots.size() == zeros.size() && found.undecided.empty() ? 1 : 0;
        ++runs;
    }
    EXPECT_GT(runs, 100);
    EXPECT_GT(decided, 0.95 * runs);
}

TEST(TrigRoots, OfTwoAnglesTurnedAndSheared) {
    // sin(2 (x + y) + a) = 0 and sin(x - y + b) = 0: x + y = -a/2 + k pi/2, x - y = -b + l pi, on
    // the torus 8 points.
    Eigen::VectorXi degrees(2);
    degrees << 2, 2;
    // (x, y) covers (x + y, x - y) twice: 16.
    for (const double a : {0.0, 0.3, 2.0}) {
        const double b = 1.1 * a + 0.2;
        const TrigRoots found = roots_of_function(degrees, [&](const Eigen::VectorXd &x) {
            return Eigen::VectorXd(
                Eigen::Vector2d(std::sin(2 * (x(0) + x(1)) + a), std::sin(x(0) - x(1) + b)));
        });
        EXPECT_EQ(found.roots.size(), 16);
        for (const Eigen::VectorXd &root : found.roots) {
            EXPECT_NEAR(std::sin(2 * (root(0) + root(1)) + a), 0, 1e-12);
            EXPECT_NEAR(std::sin(root(0) - root(1) + b), 0, 1e-12);
        }
    }
}

TEST(TrigRoots, NoneWhereOneHasNone) {
    const TrigRoots found =
        roots_of_function(Eigen::VectorXi::Constant(1, 2), [](const Eigen::VectorXd &x) {
            return Eigen::VectorXd::Constant(1, std::cos(x(0)) + 1.0001).eval();
        });
    EXPECT_TRUE(found.roots.empty());
    EXPECT_TRUE(found.undecided.empty());
}

TEST(TrigRoots, APairIsToldApartToHalfTheDigits) {
    for (const double gap : {1e-2, 1e-4}) { // roots at +- gap
        const TrigRoots found =
            roots_of_function(Eigen::VectorXi::Constant(1, 2), [&](const Eigen::VectorXd &x) {
                return Eigen::VectorXd::Constant(1, std::cos(gap) - std::cos(x(0))).eval();
            });
        EXPECT_EQ(found.roots.size(), 2);
        EXPECT_TRUE(found.undecided.empty());
    }
    const TrigRoots one =
        roots_of_function(Eigen::VectorXi::Constant(1, 2), [](const Eigen::VectorXd &x) {
            return Eigen::VectorXd::Constant(1, 1 - std::cos(x(0))).eval();
        });
    EXPECT_TRUE(one.roots.empty());
    EXPECT_EQ(one.undecided.size(), 1);
}

TEST(TrigRoots, ALineOfRootsIsRefused) {
    EXPECT_THROW((void)roots_of_function(Eigen::VectorXi::Constant(2, 1),
                                         [](const Eigen::VectorXd &x) {
                                             return Eigen::VectorXd(
                                                 Eigen::Vector2d(std::sin(x(0) - x(1)),
                                                                 std::cos(x(0) - x(1) + pi / 2)));
                                         }),
                 linalg::SolverError);
    EXPECT_THROW((void)roots_of_function(
                     Eigen::VectorXi::Constant(1, 1),
                     [](const Eigen::VectorXd &) { return Eigen::VectorXd::Zero(1).eval(); }),
                 linalg::SolverError);
}

} // namespace
} // namespace whirl::states
