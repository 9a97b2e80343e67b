// Balls that touch and balls that resist rolling, against closed forms of the same mechanics.

#include "analyses/simulate.h"
#include "closed_form/dry_friction.h"
#include "input/case_file.h"
#include "model/errors.h"
#include "simulation/dry/dry_state.h"
#include "simulation/equations.h"
#include "support/balancer_parts.h"
#include "support/balancer_scenes.h"
#include "support/rigid_jeffcott.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace whirl::simulation {
namespace {

using std::numbers::pi;
using tests::RigidJeffcott;
constexpr double radius = 0.1; ///< m, of the race

model::Balls &balls_of(model::Case &scene, std::size_t balancer = 0) {
    return std::get<model::Balls>(scene.rotor.balancers[balancer].parts);
}

/// One race in the middle; friction: largest force along the race over the normal force.
model::Case race(const RigidJeffcott &rotor, const std::vector<double> &angles, double friction) {
    model::Case scene = rotor.scene();
    scene.rotor.balancers = {
        tests::ball_balancer(0.5, static_cast<int>(angles.size()), 0.05, radius, 0, 0)};
    model::BallRow &row = balls_of(scene).rows.front();
    row.diameter = 0.02;
    row.rolling = friction * row.diameter / 2;
    scene.simulate.ball_angles = {angles};
    scene.simulate.tolerance = 1e-10;
    return scene;
}

/// So heavy and stiff that balls do not move it.
RigidJeffcott immovable() {
    RigidJeffcott rotor;
    rotor.mass = 1e9;
    rotor.kx = rotor.ky = 1e15;
    rotor.c = 1e11;
    return rotor;
}

// --- Resistance to rolling
// ------------------------------------------------------------------------

// A rotor slows down faster than friction can slow its ball. The normal force is m R g'^2, so the
// ball turns at g' = 1/(1/g'(0) + f t) until it has the speed of the rotor: from then on it stands,
// log(from/to)/f less the angle of the rotor ahead.
TEST(Rolling, StopsWhereCoulombsLawSays) {
    constexpr double friction = 0.01;
    constexpr double from = 100;
    constexpr double to = 80;
    constexpr double slowing = 0.1; // s
    model::Case scene = race(immovable(), {0.3}, friction);
    scene.simulate.run_up = {{0, from}, {slowing, to}};
    scene.simulate.time = 0.5;
    const results::SimulateResult result = analyses::simulate(scene);
    const double stop = (1 / to - 1 / from) / friction; // 0.25 s
    const double ahead =
        std::log(from / to) / friction - (from + to) / 2 * slowing - to * (stop - slowing);
    // The rotor's accelerations are 5e-11 of the ball's: what is left is the integrator's.
    const std::vector<double> &angles = result.series.angles.front();
    EXPECT_NEAR(angles.back() - 0.3, ahead, 1e-7);
    for (std::size_t k = 0; k < angles.size(); ++k) {
        const double t = result.series.time[k];
        if (t > stop + 1e-6) {
            EXPECT_EQ(angles[k], angles.back()) << t;
        } else if (t < slowing) {
            EXPECT_NEAR(angles[k] - 0.3,
                        std::log(1 + friction * from * t) / friction -
                            (from + (to - from) / slowing * t / 2) * t,
                        1e-7);
        }
    }
    EXPECT_LT(std::abs(result.audit.energy_error), 1e-8 * result.audit.energy_scale);
}

// It holds up to f m R Omega^2 and no further.
TEST(Rolling, HoldsABallUpToItsLimit) {
    constexpr double friction = 0.01;
    constexpr double speed = 100;
    const double limit = friction * speed * speed; // rad/s2, at the speed of the start
    for (const double share : {0.97, 1.01}) {
        model::Case scene = race(immovable(), {0.3, 2}, friction);
        scene.simulate.time = 0.01;
        // In this time the rotor speeds up by 1 %, so that the limit grows.
        scene.simulate.run_up = {{0, speed}, {0.01, speed + share * limit * 0.01}};
        const results::SimulateResult result = analyses::simulate(scene);
        const double moved = result.series.angles.front().back() - 0.3;
        if (share < 1) {
            EXPECT_EQ(moved, 0);
        } else {
            EXPECT_LT(moved, -1e-6);
        }
    }
}

// Where a ball stands, friction can hold it: m Omega^2 r |sin| along the race against
// f m Omega^2 (R + r cos) in a whirl of radius r that turns with the rotor. Of two balls one has at
// least s = min(sin, cos) of half the angle between them to the whirl, so r <= f R/(s - f): the set
// of equilibria of van de Wouw, van den Heuvel, Nijmeijer and van Rooij, Performance of an
// automatic ball balancer with dry friction, International Journal of Bifurcation and Chaos 15
// (2005) 65-82.
TEST(Rolling, LeavesAResidualWithinTheSetOfEquilibria) {
    constexpr double friction = 2e-4;
    RigidJeffcott rotor;
    const double speed = 2.5 * rotor.natural();
    int standing = 0;
    for (const double first : {0.4, 1.3, 2.2}) {
        model::Case scene = race(rotor, {first, first + 2}, friction);
        scene.rotor.balancers.front().imbalance = 0.006; // E = 5/3
        scene.speeds = model::SpeedRange{speed, speed, 1};
        scene.simulate.time = 6;
        scene.simulate.tolerance = 1e-9;
        const results::SimulateResult result = analyses::simulate(scene);
        const double x = result.series.x.front().back();
        const double y = result.series.y.front().back();
        const double whirl = std::hypot(x, y);
        double half = 0;
        for (int ball = 0; ball < 2; ++ball) {
            const auto &angles = result.series.angles[static_cast<std::size_t>(ball)];
            if (angles.back() != angles[angles.size() * 9 / 10])
                continue;
            ++standing;
            const double angle = speed * result.time + angles.back();
            const double along = y * std::cos(angle) - x * std::sin(angle);
            const double outward = x * std::cos(angle) + y * std::sin(angle);
            EXPECT_LE(std::abs(along), friction * (radius + outward) * (1 + 1e-6)) << first;
            half += (ball == 0 ? -0.5 : 0.5) * angles.back();
        }
        const double s = std::min(std::abs(std::sin(half)), std::abs(std::cos(half)));
        EXPECT_LE(whirl, friction * radius / (s - friction) * (1 + 1e-6)) << first;
        EXPECT_EQ(result.outcome, results::Outcome::balanced) << result.evidence;
        // All positions in which both stand, in closed form (tests/closed_form).
        const double k = 1e6 / (speed * speed) - rotor.mass - 2 * 0.05;
        const auto rest =
            closed_form::dry_rest({{k, rotor.c / speed}, 0.05, radius, friction, 0.006, 2});
        ASSERT_TRUE(rest);
        EXPECT_LE(whirl, rest->residual * (1 + 1e-6)) << first;
        EXPECT_GT(whirl, 0.01 * rest->residual) << first; // friction leaves something
    }
    EXPECT_EQ(standing, 6);
}

// Of three balls, wherever they start, no more is left than the bound: one ball's moment and seven
// tenths balance the imbalance, which no balls in a line do.
TEST(Rolling, OfThreeBallsLeavesNoMoreThanTheBound) {
    constexpr double friction = 2e-5;
    RigidJeffcott rotor;
    const double speed = 2.5 * rotor.natural();
    const double k = 1e6 / (speed * speed) - rotor.mass - 3 * 0.05;
    const auto bound =
        closed_form::dry_bound({{k, rotor.c / speed}, 0.05, radius, friction, 0.0085, 3});
    ASSERT_TRUE(bound);
    std::mt19937 random(2);
    std::uniform_real_distribution<double> angle(-pi, pi);
    double largest = 0;
    for (int start = 0; start < 12; ++start) {
        model::Case scene = race(rotor, {angle(random), angle(random), angle(random)}, friction);
        balls_of(scene).rows.front().damping = 1;
        scene.rotor.balancers.front().imbalance = 0.0085;
        scene.speeds = model::SpeedRange{speed, speed, 1};
        scene.simulate.time = 6;
        scene.simulate.tolerance = 1e-9;
        const results::SimulateResult result = analyses::simulate(scene);
        const double whirl =
            std::hypot(result.series.x.front().back(), result.series.y.front().back());
        for (const auto &angles : result.series.angles)
            EXPECT_EQ(angles.back(), angles[angles.size() * 9 / 10]) << start << ": stands";
        EXPECT_LE(whirl, *bound * (1 + 1e-6)) << start;
        largest = std::max(largest, whirl);
    }
    EXPECT_GT(largest, 0.05 * *bound); // friction leaves something
}

// --- Contact
// ----------------------------------------------------------------------------------------

double least_gap(const results::SimulateResult &result, double touching) {
    double least = HUGE_VAL;
    const auto &angles = result.series.angles;
    for (std::size_t k = 0; k < result.series.time.size(); ++k)
        for (std::size_t i = 0; i < angles.size(); ++i)
            for (std::size_t j = 0; j < i; ++j)
                least =
                    std::min(least, std::abs(std::remainder(angles[i][k] - angles[j][k], 2 * pi)) -
                                        touching);
    return least;
}

// Below the critical speed balls gather where the rotor is heavy. Without contact all end in one
// place, and a note says so; with it they stand side by side at their diameter.
TEST(Contact, KeepsBallsApartByTheirDiameter) {
    RigidJeffcott rotor;
    const double speed = 0.6 * rotor.natural();
    for (const double restitution : {0.0, 0.5, 0.9}) {
        model::Case scene = race(rotor, {0.4, 1.5, 3.5}, 0);
        scene.rotor.balancers.front().imbalance = 0.003;
        balls_of(scene).rows.front().damping = 1;
        balls_of(scene).contact = true;
        balls_of(scene).restitution = restitution;
        scene.speeds = model::SpeedRange{speed, speed, 1};
        scene.simulate.time = 3;
        scene.simulate.tolerance = 1e-9;
        const double touching = balls_of(scene).rows.front().touching_angle();
        const results::SimulateResult result = analyses::simulate(scene);
        EXPECT_GT(least_gap(result, touching), -1e-9) << restitution;
        std::vector<double> last;
        for (const auto &angles : result.series.angles)
            last.push_back(angles.back());
        EXPECT_NEAR(last[1] - last[0], touching, 1e-8) << restitution;
        EXPECT_NEAR(std::remainder(last[2] - last[1], 2 * pi), touching, 1e-8) << restitution;
        EXPECT_GT(result.impacts.value(), 0);
        EXPECT_LT(result.audit.impact_gain, 1e-12);
        EXPECT_LT(std::abs(result.audit.energy_error), 1e-6 * result.audit.energy_scale);
    }
}

// Two balls under gravity in a race at rest, both as high: each falls against the plane of
// symmetry, so the k-th impact has restitution^k of the first one's speed, until parts stay
// together: at 1e-5 of the fastest spin speed. A race that turns at last, without damping, does not
// move them.
TEST(Contact, BouncesAsOftenAsRestitutionSays) {
    const double height = 0.3; // rad, above where they touch
    const double g = 9.81;
    for (const double restitution : {0.0, 0.3, 0.9}) {
        RigidJeffcott heavy;
        heavy.mass = 1e4;
        heavy.kx = heavy.ky = 1e10;
        heavy.c = 1e6;
        model::Case scene = race(heavy, {0, 1}, 0);
        balls_of(scene).contact = true;
        balls_of(scene).restitution = restitution;
        scene.simulate.tolerance = 1e-9;
        const double touching = balls_of(scene).rows.front().touching_angle();
        const double half = touching / 2;
        scene.simulate.ball_angles = {{-pi / 2 - half - height, -pi / 2 + half + height}};
        scene.simulate.gravity = g;
        scene.simulate.run_up = {{0, 0}, {9.9, 0}, {10, 100}};
        scene.simulate.time = 10;
        const double first = 2 * std::sqrt(2 * g / radius * (cos(half) - cos(half + height)));
        long expected = 0;
        for (double speed = first; speed > 1e-5 * 100; speed *= restitution)
            ++expected;
        const results::SimulateResult result = analyses::simulate(scene);
        EXPECT_EQ(result.impacts.value(), expected) << restitution;
        EXPECT_GT(least_gap(result, touching), -1e-9) << restitution;
        const auto &angles = result.series.angles;
        EXPECT_NEAR(angles[1].back() - angles[0].back(), touching, 1e-9) << restitution;
        EXPECT_LT(result.audit.impact_gain, 1e-12) << restitution;
    }
}

// Four balls a race that lie against each other while they swing: once a step met parts that came
// apart from a little too near and did not end.
TEST(Contact, OfCrowdedBallsEnds) {
    model::Case scene =
        input::load_case(std::string(WHIRL_ROOT) + "/cases/extractor_two_plane", {});
    for (std::size_t i = 0; i < 2; ++i)
        balls_of(scene, i).contact = true;
    scene.simulate.time = 4;
    for (const double speed : {100.0, 140.0, 200.0}) {
        scene.speeds = model::SpeedRange{speed, speed, 1};
        const results::SimulateResult result = analyses::simulate(scene);
        EXPECT_GT(result.impacts.value(), 20) << speed;
        EXPECT_LT(result.impacts.value(), 2000) << speed;
        EXPECT_LT(result.audit.impact_gain, 1e-12) << speed;
        EXPECT_LT(std::abs(result.audit.energy_error), 1e-6 * result.audit.energy_scale) << speed;
        const auto &angles = result.series.angles;
        for (const std::size_t first : {0U, 4U}) // of its balancer
            for (std::size_t i = first; i < first + 4; ++i)
                for (std::size_t j = first; j < i; ++j) {
                    const double apart =
                        std::remainder(angles[i].back() - angles[j].back(), 2 * pi);
                    EXPECT_GT(std::abs(apart), balls_of(scene).rows.front().touching_angle() - 1e-8)
                        << speed;
                }
    }
}

TEST(Contact, IsMissedWhereBallsOverlap) {
    RigidJeffcott rotor;
    const double speed = 0.6 * rotor.natural();
    model::Case scene = race(rotor, {0.4, 1.5, 3.5}, 0);
    scene.rotor.balancers.front().imbalance = 0.003;
    balls_of(scene).rows.front().damping = 1;
    scene.speeds = model::SpeedRange{speed, speed, 1};
    scene.simulate.time = 3;
    const results::SimulateResult result = analyses::simulate(scene);
    EXPECT_TRUE(std::any_of(result.model.notes.begin(), result.model.notes.end(),
                            [](const std::string &note) {
                                return note.find("3 pairs of balls overlap") != std::string::npos;
                            }));
}

// An impulse P between two balls changes the velocities by P M^-1 J^T: an elastic impact keeps the
// kinetic energy, a plastic one takes the part that belongs to the approach.
TEST(Impact, KeepsOrTakesTheEnergyOfTheApproach) {
    model::Case scene = tests::flexible_rotor(300);
    for (std::size_t i = 0; i < 2; ++i) {
        balls_of(scene, i).contact = true;
        balls_of(scene, i).rows.front().diameter = 0.015;
    }
    MotionScene motion = motion_scene(scene);
    RotorMotion rotor(motion.parts);
    rotor.set_dry(dry_state(rotor.parts(), motion.start_angles, 300));
    rotor.enter_piece(0.1);
    Eigen::VectorXd state = Eigen::VectorXd::Zero(rotor.size());
    for (Eigen::Index i = 0; i < 2 * rotor.coordinates(); ++i)
        state(i) = (i < rotor.coordinates() ? 1e-4 : 1e-2) * std::sin(3.0 * static_cast<double>(i));
    for (std::size_t i = 0; i < motion.start_angles.size(); ++i)
        state(rotor.first_angle() + static_cast<Eigen::Index>(i)) = motion.start_angles[i];
    ASSERT_EQ(rotor.dry().gaps.size(), 5U); // three balls, and two
    for (const Gap &gap : rotor.dry().gaps) {
        const Eigen::VectorXd response = rotor.impulse_response(0.1, state.data(), gap);
        const Eigen::Index at = rotor.first_angle();
        const int n = rotor.coordinates();
        const double mobility = response(at + gap.second) - response(at + gap.first);
        const double approach = state(n + at + gap.second) - state(n + at + gap.first);
        const RotorMotion::Totals before = rotor.totals(0.1, state.data());
        for (const double restitution : {0.0, 0.6, 1.0}) {
            Eigen::VectorXd after = state;
            after.segment(n, n) -= (1 + restitution) * approach / mobility * response;
            // Both with what the drive gives that keeps the speed.
            const RotorMotion::Totals now = rotor.totals(0.1, after.data());
            const double impulse = now.momentum - before.momentum;
            const double lost = before.energy + 300 * impulse - now.energy;
            const double expected =
                (1 - restitution * restitution) * approach * approach / mobility / 2;
            // The energy of the spin is the largest part of both.
            EXPECT_NEAR(lost, expected, 1e-13 * before.energy);
        }
    }
}

// All at once on a flexible rotor: books close, no impact creates energy, nothing overlaps.
TEST(ContactAndRolling, KeepTheBooks) {
    model::Case scene = tests::flexible_rotor(300);
    for (std::size_t i = 0; i < 2; ++i) {
        model::Balls &balls = balls_of(scene, i);
        balls.contact = true;
        balls.restitution = 0.7;
        balls.rows.front().diameter = 0.015;
        balls.rows.front().rolling = 2e-5;
    }
    scene.simulate.time = 0.2;
    scene.simulate.gravity = 9.81;
    scene.simulate.tolerance = 1e-9;
    const results::SimulateResult result = analyses::simulate(scene);
    EXPECT_LT(std::abs(result.audit.energy_error), 1e-6 * result.audit.energy_scale);
    EXPECT_LT(std::abs(result.audit.momentum_error), 1e-6 * result.audit.momentum_scale);
    EXPECT_LT(result.audit.impact_gain, 1e-12);
}

TEST(Contact, RefusesBallsThatOverlapAtTheStart) {
    model::Case scene = race(RigidJeffcott(), {0.1, 0.2}, 0);
    balls_of(scene).contact = true;
    scene.speeds = model::SpeedRange{200, 200, 1};
    scene.simulate.time = 1;
    EXPECT_THROW((void)analyses::simulate(scene), model::BadInput);
}

} // namespace
} // namespace whirl::simulation
