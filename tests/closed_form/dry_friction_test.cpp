// Where two balls with dry friction rest, against their conditions over all pairs of angles.

#include "closed_form/dry_friction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>
#include <vector>

namespace whirl::closed_form {
namespace {

using std::numbers::pi;
using Complex = std::complex<double>;

/// The planar rotor of the case jeffcott_two_balls at a speed.
DryBalls planar(double speed, double friction, double imbalance) {
    return {Complex(1e6 / (speed * speed) - 10.1, 632.4 / speed), 0.05, 0.1, friction, imbalance};
}

Complex deflection(const DryBalls &b, double first, double second) {
    return (b.imbalance + b.mass * b.radius * (std::polar(1.0, first) + std::polar(1.0, second))) /
           b.K;
}

bool stands(const DryBalls &b, Complex w, double angle) {
    const Complex seen = w * std::polar(1.0, -angle);
    return std::abs(seen.imag()) <= b.friction * (b.radius + seen.real());
}

/// Largest deflection over a grid of pairs of angles that stand, those from which balance is
/// reached over neighbours that stand.
double largest_over_grid(const DryBalls &b, int n) {
    const auto angle = [n](int i) { return 2 * pi * i / n; };
    const double balanced = std::acos(-b.imbalance / (2 * b.mass * b.radius));
    const int start = static_cast<int>(std::lround(balanced / (2 * pi) * n));
    std::vector<bool> seen(static_cast<std::size_t>(n) * n);
    std::queue<std::pair<int, int>> open;
    open.emplace(start, n - start);
    double largest = 0;
    while (!open.empty()) {
        const auto [i, k] = open.front();
        open.pop();
        const int first = (i % n + n) % n, second = (k % n + n) % n;
        const auto place = static_cast<std::size_t>(first) * n + second;
        const Complex w = deflection(b, angle(first), angle(second));
        if (seen[place] || !stands(b, w, angle(first)) || !stands(b, w, angle(second)))
            continue;
        seen[place] = true;
        largest = std::max(largest, std::abs(w));
        for (const auto &[di, dk] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}})
            open.emplace(first + di, second + dk);
    }
    return largest;
}

class DryRestAt : public testing::TestWithParam<DryBalls> {};

// The grid is inside of the set: its largest deflection is below the closed form by what some steps
// of the angles change, m R/|K| times the step for either ball: the set is largest at a corner,
// which may be narrower than the grid.
TEST_P(DryRestAt, HoldsTheLargestDeflectionOfAllPairsOfAngles) {
    const DryBalls &b = GetParam();
    const int n = b.friction > 2e-3 ? 1000 : 4000; // wide, and narrow sets
    const auto rest = dry_rest(b);
    ASSERT_TRUE(rest);
    const double step = 2 * b.mass * b.radius / std::abs(b.K) * 2 * pi / n;
    const double grid = largest_over_grid(b, n);
    EXPECT_LE(grid, rest->residual * (1 + 1e-12));
    EXPECT_GE(grid, rest->residual - 4 * step);
    // The bound that holds whatever the rotor: one of the balls stands by min(sin, cos) of half the
    // angle between them off the line of w. Here the angle is that of balance, changed by what the
    // residual takes of the imbalance.
    const double moved = rest->residual * std::abs(b.K) / (2 * b.mass * b.radius);
    const double cosine = b.imbalance / (2 * b.mass * b.radius);
    double s = 1; // least over the changed angles
    for (const double c : {cosine - moved, cosine + moved})
        s = std::min({s, std::abs(c), std::sqrt(std::max(1 - c * c, 0.0))});
    if (s > b.friction) {
        EXPECT_LE(rest->residual, b.friction * b.radius / (s - b.friction) * (1 + 1e-12));
    }
}

INSTANTIATE_TEST_SUITE_P(Rotors, DryRestAt,
                         testing::Values(planar(500, 1e-3, 0.004), planar(500, 1e-2, 0.004),
                                         planar(800, 2e-3, 0.007), planar(430, 3e-3, 0.002),
                                         planar(330, 2e-3, 0.005)));

// Just inside of its ends both mirrored balls stand, just outside one of them does not.
TEST(DryRest, MirroredBallsStandBetweenItsEnds) {
    const DryBalls b = planar(500, 1e-3, 0.004);
    const auto rest = dry_rest(b);
    ASSERT_TRUE(rest);
    const double balanced = std::acos(-0.4);
    EXPECT_LT(rest->from, balanced);
    EXPECT_GT(rest->to, balanced);
    const auto both = [&b](double angle) {
        const Complex w = deflection(b, angle, -angle);
        return stands(b, w, angle) && stands(b, w, -angle);
    };
    for (const auto &[end, outwards] : {std::pair{rest->from, -1.0}, {rest->to, 1.0}}) {
        EXPECT_TRUE(both(end - outwards * 1e-9));
        EXPECT_FALSE(both(end + outwards * 1e-9));
    }
    // To first order in friction, along the mirrored way: |w| = 2 m R sin(a) d/|K|, a ball stands
    // up to f R/|sin(a - arg w)|; the worse of the two decides.
    const double tilt = std::arg(b.K);
    const double worse =
        std::max(std::abs(std::sin(balanced + tilt)), std::abs(std::sin(balanced - tilt)));
    const double width = b.friction * b.radius * std::abs(b.K) /
                         (2 * b.mass * b.radius * std::sin(balanced) * worse);
    EXPECT_NEAR((rest->to - rest->from) / 2, width, 0.03 * width); // f, and width^2, over it
}

// Friction small: the residual grows with it in proportion.
TEST(DryRest, ShrinksWithTheFriction) {
    const auto residual = [](double friction) {
        return dry_rest(planar(500, friction, 0.004)).value().residual;
    };
    // The residual over the friction tends to a limit: R over the least of sin and cos of half the
    // angle between the balls, or less.
    const double limit = 0.1 / std::min(0.4, std::sqrt(1 - 0.16));
    EXPECT_LE(residual(1e-6) / 1e-6, limit * (1 + 1e-3));
    EXPECT_NEAR(residual(1e-6) / 1e-6, residual(1e-7) / 1e-7, 1e-3 * limit);
}

TEST(DryRest, IsNoneWhereTheBallsCannotBalance) {
    EXPECT_FALSE(dry_rest(planar(500, 1e-3, 0.011)));
}

} // namespace
} // namespace whirl::closed_form
