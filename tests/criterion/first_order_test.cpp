// The balancers' own motions to first order in their mass, between the criterion (no mass) and the
// eigenvalues of the balanced position with the whole rotor.

#include "analyses/balance.h"
#include "assembly/rotating_system.h"
#include "balancers/arrangement.h"
#include "criterion/first_order.h"
#include "support/balancer_scenes.h"
#include "support/dense_eigenvalues.h"
#include "support/random.h"
#include "support/rigid_jeffcott.h"
#include "support/ring_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <limits>
#include <numbers>

namespace {

using namespace whirl;
using Complex = std::complex<double>;

criterion::SlowMotions slow_motions(const model::Rotor &rotor, int order = 3) {
    return {rotor, [&rotor](double) { return balancers::arrangement_at_balance(rotor); }, order};
}

/// With the given mass of a ball and damping over mass.
void add_balls(model::Case &scene, double z, double radius, double mass, double rate, double E) {
    scene.rotor.balancers.push_back(
        tests::ball_balancer(z, 2, mass, radius, rate * mass, 2 * mass * radius / E));
}

/// One plane of a damped rigid rotor on two supports.
model::Case rigid_rotor(double mass, double rate) {
    model::Case scene;
    scene.rotor.shaft = tests::uniform_shaft(0.9, 0.01, tests::weightless_steel());
    scene.rotor.shaft.rigid = true;
    scene.rotor.discs = {tests::disc_at(0.4, 60, 3, 1)};
    scene.rotor.bearings = {tests::isotropic_bearing(0, 2e6, 1500),
                            tests::isotropic_bearing(0.9, 3e6, 2000)};
    add_balls(scene, 0.6, 0.1, mass, rate, 2);
    scene.speeds = model::SpeedRange{250, 650, 41};
    return scene;
}

/// Two planes of a damped flexible rotor.
model::Case flexible_rotor(double mass, double rate) {
    model::Case scene;
    scene.rotor.shaft = tests::uniform_shaft(1.2, 0.09, tests::steel());
    scene.rotor.shaft.order = 3;
    scene.rotor.discs = {tests::disc_at(0.3, 25, 0.15, 0.25), tests::disc_at(0.9, 20, 0.12, 0.2)};
    scene.rotor.bearings = {tests::isotropic_bearing(0, 2e6, 1000),
                            tests::isotropic_bearing(1.2, 2.5e6, 1250)};
    for (const double z : {0.25, 0.95})
        add_balls(scene, z, 0.12, mass, rate, 2);
    scene.speeds = model::SpeedRange{300, 2600, 47};
    return scene;
}

/// Distances of all first-order roots from the nearest of the whole rotor, the largest of them.
double off_by(const model::Case &scene, double speed) {
    const int order = 3;
    const auto balls =
        balancers::balancer_elements(scene.rotor, balancers::arrangement_at_balance(scene.rotor));
    model::Rotor bare = scene.rotor;
    const assembly::Discretization mesh(bare, order);
    const auto whole =
        tests::dense_eigenvalues(assembly::assemble_rotating(mesh, speed, balls), speed);
    double largest = 0;
    for (const Complex root : slow_motions(scene.rotor, order).roots(speed)) {
        double nearest = std::numeric_limits<double>::infinity();
        for (const Complex other : whole)
            nearest = std::min(nearest, std::abs(other - root));
        largest = std::max(largest, nearest);
    }
    return largest;
}

// Roots are of order sqrt(m), what is left out, m l^2 B'' and the m^2 that the masses of the balls
// change B by off the mean, of order m^2 in l^2: m^(3/2) in l.
TEST(FirstOrder, RootsAreThoseOfTheWholeRotorToThreeHalvesOfTheMass) {
    for (const auto &[scene_of, speed] :
         {std::pair(&rigid_rotor, 400.0), std::pair(&rigid_rotor, 300.0),
          std::pair(&flexible_rotor, 900.0), std::pair(&flexible_rotor, 2400.0)}) {
        double before = 0;
        for (const double mass : {0.04, 0.01, 0.0025, 0.000625}) {
            const double off = off_by(scene_of(mass, 100 * std::sqrt(mass)), speed);
            if (before > 0)
                EXPECT_NEAR(std::log2(before / off) / 2, 1.5, 0.15) << speed << " " << mass;
            before = off;
        }
    }
}

// Balls that differ, of which only the rates of some motions matter; a ball alone, which moves
// along one direction; rings that turn on their journals.
TEST(FirstOrder, RootsOfOtherBalancersAreThoseOfTheWholeRotor) {
    const auto balls_that_differ = [](double mass, double rate) {
        model::Case scene = rigid_rotor(mass, rate);
        auto &rows = std::get<model::Balls>(scene.rotor.balancers[0].parts).rows;
        rows.push_back(rows.front());
        rows.back().mass *= 1.5;
        return scene;
    };
    const auto one_ball = [](double mass, double rate) {
        model::Case scene = rigid_rotor(mass, rate);
        tests::row(scene.rotor.balancers[0]).n = 1;
        scene.rotor.balancers[0].imbalance = mass * tests::row(scene.rotor.balancers[0]).radius;
        return scene;
    };
    const auto rings = [](double mass, double rate) {
        model::Case scene = rigid_rotor(mass, rate);
        model::Balancer ring = tests::ring_balancer(0.6, 2, 0.01 * mass);
        auto &of = std::get<model::Rings>(ring.parts);
        of.inertia *= mass / of.mass;
        of.damping = rate * mass;
        of.drag *= rate * mass;
        of.mass = mass;
        scene.rotor.balancers = {ring};
        return scene;
    };
    const std::vector<std::function<model::Case(double, double)>> scenes{balls_that_differ,
                                                                         one_ball, rings};
    for (std::size_t i = 0; i < scenes.size(); ++i) {
        const double heavy = off_by(scenes[i](0.0025, 100 * std::sqrt(0.0025)), 400);
        const double light = off_by(scenes[i](0.000625, 100 * std::sqrt(0.000625)), 400);
        EXPECT_NEAR(std::log2(heavy / light) / 2, 1.5, 0.15) << i;
    }
}

using Errors = std::vector<double>;

/// Ends inside the range of first-order bands less those of others, rad/s.
Errors ends_off(const results::FirstOrder &first, const std::vector<results::Interval> &other,
                const model::SpeedRange &range) {
    Errors out;
    EXPECT_EQ(first.bands.size(), other.size());
    for (std::size_t i = 0; i < std::min(first.bands.size(), other.size()); ++i) {
        if (first.bands[i].from > range.from)
            out.push_back(std::abs(first.bands[i].from - other[i].from));
        if (first.bands[i].to < range.to)
            out.push_back(std::abs(first.bands[i].to - other[i].to));
    }
    return out;
}

/// A quarter of the mass, a quarter of what the ends are off, to the root of the mass over that of
/// the rotor.
void expect_quarters(const std::vector<Errors> &off, double tolerance) {
    for (std::size_t k = 1; k < off.size(); ++k) {
        ASSERT_EQ(off[k].size(), off[0].size());
        ASSERT_FALSE(off[k].empty());
        for (std::size_t i = 0; i < off[k].size(); ++i)
            EXPECT_NEAR(off[k - 1][i] / off[k][i], 4, tolerance) << k << " " << i;
    }
}

// With the damping over mass of the balls as the root of their mass both keep the same ends in the
// limit, inside of the criterion's, and what is left out is of the order of the mass.
TEST(FirstOrder, BandsMeetThoseOfTheWholeRotorInProportionToTheMass) {
    for (const auto &scene_of : {&rigid_rotor, &flexible_rotor}) {
        std::vector<Errors> off;
        for (const double mass : {0.001, 0.00025}) {
            const model::Case scene = scene_of(mass, 100 * std::sqrt(mass));
            const results::BalanceResult result = analyses::balance(scene);
            ASSERT_TRUE(result.first_order && result.balanced_position);
            off.push_back(
                ends_off(*result.first_order, result.balanced_position->bands, *scene.speeds));
        }
        expect_quarters(off, 0.25);
    }
}

// With all of the damping over mass that they have, the drag of light balls is large against what
// drives them, and one plane keeps where the criterion says so.
TEST(FirstOrder, BandsMeetThoseOfTheCriterionInProportionToTheMass) {
    std::vector<Errors> off;
    for (const double mass : {0.004, 0.001, 0.00025}) {
        const model::Case scene = rigid_rotor(mass, 40);
        const results::BalanceResult result = analyses::balance(scene);
        ASSERT_TRUE(result.first_order);
        off.push_back(ends_off(*result.first_order, result.joint.bands.bands, *scene.speeds));
    }
    expect_quarters(off, 0.4);
}

/// A point mass on a spring and a damper with two balls 90 deg apart, D = 0.
struct PlanarBalls {
    tests::RigidJeffcott rotor;
    double ball = 0.05;
    double rate = 3;

    [[nodiscard]] model::Case scene() const {
        model::Case scene = rotor.scene();
        add_balls(scene, 0.5, 0.1, ball, rate, std::numbers::sqrt2);
        return scene;
    }
    /// (n m/2) B and (n m/2) B' of s^4/(M s^2 + c s + k), M with the balls.
    [[nodiscard]] std::pair<Complex, Complex> driven(double speed) const {
        const double M = rotor.mass + 2 * ball;
        const Complex s(0, speed);
        const Complex Z = M * s * s + rotor.c * s + rotor.kx;
        const Complex B = std::pow(s, 4) / Z;
        return {ball * B, ball * (4.0 / s - (2 * M * s + rotor.c) / Z) * B};
    }
};

// l^2 + (h - mu B') l - mu B = 0 and its conjugate.
TEST(FirstOrder, RootsOfAPlanarRotorInClosedForm) {
    const PlanarBalls balls;
    const model::Case scene = balls.scene();
    criterion::SlowMotions motions = slow_motions(scene.rotor);
    for (const double speed : {200.0, 330.0, 500.0, 900.0}) {
        const auto [B, rate] = balls.driven(speed);
        const Eigen::VectorXcd found = motions.roots(speed);
        ASSERT_EQ(found.size(), 4);
        const Complex half = (balls.rate - rate) / 2.0;
        for (const double sign : {-1.0, 1.0}) {
            const Complex root = -half + sign * std::sqrt(half * half + B);
            for (const Complex expected : {root, std::conj(root)})
                EXPECT_LT((found.array() - expected).abs().minCoeff(), 1e-11 * std::abs(root));
        }
    }
}

// With l^2 + (x + i g) l + b + i c = 0 all roots die out for b x^2 + g c x > c^2, x > 0.
TEST(FirstOrder, LeastDragOfAPlanarRotorInClosedForm) {
    const PlanarBalls balls;
    const model::Case scene = balls.scene();
    criterion::SlowMotions motions = slow_motions(scene.rotor);
    for (const double speed : {330.0, 400.0, 500.0, 900.0}) {
        const auto [B, rate] = balls.driven(speed);
        const double b = -B.real();
        const double c = -B.imag();
        const double g = -rate.imag();
        const double x = (-g * c + std::abs(c) * std::sqrt(g * g + 4 * b)) / (2 * b);
        const auto least = motions.least_drag(speed);
        ASSERT_TRUE(least) << speed;
        EXPECT_NEAR(*least * balls.rate, x + rate.real(), 1e-9 * balls.rate) << speed;
    }
    EXPECT_FALSE(motions.least_drag(250)); // below the resonance
}

// Bearings over speed are those of the speed, asked for in any order.
TEST(FirstOrder, TakesBearingsAsAtTheSpeed) {
    const PlanarBalls balls;
    model::Case scene = balls.scene();
    for (model::Bearing &bearing : scene.rotor.bearings) {
        bearing.speeds = {200, 600};
        bearing.rows.push_back(bearing.rows.front());
        bearing.rows.back().k *= 1.4;
    }
    criterion::SlowMotions motions = slow_motions(scene.rotor);
    for (const double share : {0.75, 0.25, 0.5}) {
        PlanarBalls here = balls;
        here.rotor.kx = here.rotor.ky = 1e6 * (1 + 0.4 * share);
        const model::Case constant = here.scene();
        const double speed = 200 + 400 * share;
        EXPECT_NEAR(motions.growth(speed), slow_motions(constant.rotor).growth(speed),
                    1e-9 * speed);
    }
}

// Two balancers in one plane are one with all of their balls: their difference makes no force, and
// where it stands is of no consequence.
TEST(FirstOrder, BalancersInOnePlaneAreOne) {
    const PlanarBalls balls;
    model::Case two = balls.scene();
    two.rotor.balancers.push_back(two.rotor.balancers[0]);
    model::Case one = balls.scene();
    tests::row(one.rotor.balancers[0]).n = 4;
    one.rotor.balancers[0].imbalance *= 2;
    const double right = std::numbers::pi / 4;
    one.rotor.balancers[0].position = {right * 3, right * 3, -right * 3, -right * 3};
    criterion::SlowMotions of_two = slow_motions(two.rotor);
    criterion::SlowMotions of_one = slow_motions(one.rotor);
    for (const double speed : {330.0, 400.0, 500.0, 900.0}) {
        const auto least = of_one.least_drag(speed);
        const auto same = of_two.least_drag(speed);
        ASSERT_TRUE(least && same);
        EXPECT_NEAR(*same, *least, 1e-9 * *least);
        EXPECT_NEAR(of_two.growth(speed), of_one.growth(speed), 1e-9 * speed);
    }
}

// Of a rotor with several planes, balls of several kinds and any damping.
TEST(FirstOrder, RootsBeginToDieOutAtTheLeastDrag) {
    tests::Random random(31);
    int found = 0;
    for (int i = 0; i < 40; ++i) {
        model::Case scene = flexible_rotor(random(0.001, 0.05), 1);
        for (model::Balancer &balancer : scene.rotor.balancers) {
            tests::row(balancer).n = 2 + i % 3;
            tests::row(balancer).damping = tests::row(balancer).mass * random(0.1, 30);
            balancer.imbalance = random(0.2, 1) * tests::row(balancer).n *
                                 tests::row(balancer).mass * tests::row(balancer).radius;
        }
        criterion::SlowMotions motions = slow_motions(scene.rotor);
        const double speed = random(300, 2600);
        const auto growth = [&](double drag) {
            return motions.roots(speed, drag).real().maxCoeff();
        };
        const auto least = motions.least_drag(speed);
        if (!least) { // some motion grows at any drag, or at a large one
            EXPECT_GT(growth(1e3), 0) << i;
            continue;
        }
        for (const double more : {1.001, 1.1, 2.0, 10.0, 100.0})
            EXPECT_LT(growth(*least * more), 0) << i;
        if (*least == 0)
            continue;
        ++found;
        EXPECT_GT(growth(*least * 0.999), 0) << i;
    }
    EXPECT_GT(found, 10);
}

// The mean of the forward motion of a turn is all that a slow motion sees of bearings that differ
// between their directions, to first order in the mass.
TEST(FirstOrder, BandsOnAnisotropicBearingsMeetThoseOfTheWholeRotor) {
    tests::RigidJeffcott rotor;
    rotor.kx = 0.9e6;
    rotor.ky = 1.2e6;
    std::vector<Errors> off;
    for (const double mass : {0.001, 0.00025}) {
        model::Case scene = rotor.scene();
        add_balls(scene, 0.5, 0.1, mass, 100 * std::sqrt(mass), 2);
        scene.speeds = model::SpeedRange{280, 600, 33};
        const results::BalanceResult result = analyses::balance(scene);
        ASSERT_TRUE(result.first_order && result.balanced_position);
        off.push_back(
            ends_off(*result.first_order, result.balanced_position->bands, *scene.speeds));
    }
    expect_quarters(off, 0.25);
}

} // namespace
