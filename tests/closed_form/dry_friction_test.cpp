// Where balls with dry friction rest, against their conditions over all pairs of angles of two, and
// random angles of more.

#include "closed_form/dry_friction.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>
#include <random>
#include <vector>

namespace whirl::closed_form {
namespace {

using std::numbers::pi;
using Complex = std::complex<double>;

/// The planar rotor of the case jeffcott_two_balls at a speed.
DryBalls planar(double speed, double friction, double imbalance) {
    return {
        Complex(1e6 / (speed * speed) - 10.1, 632.4 / speed), 0.05, 0.1, friction, imbalance, 2};
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

/// The same with n balls.
DryBalls planar_of(int n, double friction, double imbalance) {
    DryBalls out = planar(500, friction, imbalance);
    out.K -= (n - 2) * out.mass;
    out.n = n;
    return out;
}

/// Moment of one ball on that rotor, kg m.
constexpr double one_ball = 0.05 * 0.1;

/// The bound to first order in the friction, over the radius of the race and the friction.
double first_order(int n, double u) {
    double least = 1;
    for (int k = (n + 1) / 2; k <= n; ++k) {
        const int l = n - k;
        if (u >= k - l && l > 0)
            least = std::min(least, (u * u - (k - l) * (k - l)) / (4.0 * k * l));
        else if (u < k - l)
            least = std::min(least, k % 2 == 0 ? 1 - std::pow((u + l) / k, 2)
                                               : 1 - ((u + l) * (u + l) - 1) / (k * k - 1.0));
    }
    return 1 / std::sqrt(least);
}

TEST(DryBound, GrowsWithTheFrictionAsInFirstOrder) {
    for (int n = 2; n <= 6; ++n)
        for (const double u : {0.35, 0.8, 1.4, 2.7, 4.1}) {
            if (u > n)
                continue;
            const auto bound = dry_bound(planar_of(n, 1e-9, u * one_ball));
            ASSERT_TRUE(bound) << n << " " << u;
            // Left out: the friction over s, and what the residual takes of the imbalance.
            EXPECT_NEAR(*bound / (1e-9 * 0.1), first_order(n, u), 1e-4 * first_order(n, u))
                << n << " " << u;
        }
}

// Of two balls that is the bound by the angle between them, and the exact one is no larger.
TEST(DryBound, OfTwoBallsIsNoLessThanTheirExactOne) {
    for (const double speed : {430.0, 500.0, 800.0})
        for (const double u : {0.3, 0.8, 1.2, 1.7}) {
            const DryBalls b = planar(speed, 1e-5, u * one_ball);
            const auto exact = dry_rest(b);
            const auto bound = dry_bound(b);
            ASSERT_TRUE(exact && bound);
            EXPECT_LE(exact->residual, *bound * (1 + 1e-12));
            EXPECT_NEAR(first_order(2, u), 1 / std::min(u / 2, std::sqrt(1 - u * u / 4)), 1e-12);
        }
}

// Balls that stand at random under a deflection balance some imbalance all but for what makes that
// deflection. None of these positions is just beyond the bound of its imbalance, and some come near
// to it.
TEST(DryBound, HoldsForBallsThatStandAtRandom) {
    constexpr double friction = 1e-6;
    std::mt19937 random(5);
    std::uniform_real_distribution<double> share(0, 1);
    for (int n = 2; n <= 6; ++n) {
        int within = 0;
        double nearest = 0;
        for (int draw = 0; draw < 20000; ++draw) {
            const double r = friction * 0.1 * std::exp(3 * share(random));
            DryBalls b = planar_of(n, friction, 0);
            Complex sum = r * b.K / one_ball; // in the direction of w
            std::vector<double> angles;
            for (int ball = 0; ball < n; ++ball) {
                // Ends of the arcs on which a ball stands, or between: r sin(|a| - e) = R sin e.
                const double e = std::atan(friction);
                const double half = std::asin(std::min(1.0, 0.1 * std::sin(e) / r));
                const bool ahead = share(random) < 0.5;
                const double end = ahead ? half + e : half - e;
                const double at = share(random) < 0.7 ? end : end * share(random);
                const double side = share(random) < 0.5 ? 1 : -1;
                angles.push_back(side * (ahead ? at : pi - at) * (1 - 1e-12));
                sum -= std::polar(1.0, angles.back());
            }
            b.imbalance = std::abs(sum) * one_ball;
            if (!std::ranges::all_of(angles, [&](double a) { return stands(b, r, a); }))
                continue; // rounding at an end
            const auto bound = dry_bound(b);
            if (!bound)
                continue;
            EXPECT_FALSE(r > *bound * (1 + 1e-9) && r < 1.05 * *bound)
                << n << " balls, " << std::abs(sum) << " of one, " << r << " m";
            within += r <= *bound ? 1 : 0;
            if (r <= *bound)
                nearest = std::max(nearest, r / *bound);
        }
        EXPECT_GT(within, 1000) << n;
        EXPECT_GT(nearest, 0.99) << n;
    }
}

// Balls on the line of the imbalance that balance it stand whatever the deflection along it.
TEST(DryBound, IsNoneWhereBallsInALineBalance) {
    EXPECT_FALSE(dry_bound(planar_of(3, 1e-6, one_ball)));
    EXPECT_FALSE(dry_bound(planar_of(4, 1e-6, 2 * one_ball)));
    EXPECT_TRUE(dry_bound(planar_of(4, 1e-6, one_ball)));
    EXPECT_FALSE(dry_bound(planar_of(3, 1e-6, 3.01 * one_ball)));
}

} // namespace
} // namespace whirl::closed_form
