// Walls across the races of balls: against bouncing in closed form, steady motions with the balls
// fixed where they rest, and what is conserved.

#include "analyses/simulate.h"
#include "analyses/stability.h"
#include "balancers/kind.h"
#include "model/errors.h"
#include "results/simulate.h"
#include "simulation/equations.h"
#include "simulation/restart.h"
#include "states/state_search.h"
#include "support/balancer_scenes.h"
#include "support/rigid_jeffcott.h"
#include "support/written_case.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

namespace whirl::walls {
namespace {

using Complex = std::complex<double>;
using std::numbers::pi;

model::Balls &balls_of(model::Balancer &balancer) { return std::get<model::Balls>(balancer.parts); }

constexpr double ball_mass = 0.05; ///< kg
constexpr double radius = 0.1;     ///< m

/// A planar rotor with two balls.
model::Case planar(const tests::RigidJeffcott &rotor, double drag, double imbalance) {
    model::Case scene = rotor.scene();
    scene.name = "walls";
    model::Balancer balancer = tests::ball_balancer(0.5, 2, ball_mass, radius, drag, imbalance);
    balancer.tilt_inertia = false;
    balls_of(balancer).rows.front().diameter = 0.02;
    scene.rotor.balancers = {balancer};
    return scene;
}
const double beside = std::asin(0.1); ///< of a ball at a wall, rad

// Left behind by a rotor that speeds up, a ball falls against the wall behind it as a body falls to
// the ground, and bounces as that does: each time for `restitution` of the time before. Two do so
// opposite each other in a rotor so heavy that it stays where it is.
TEST(Walls, BallsBounceAsOnTheGround) {
    tests::RigidJeffcott rotor;
    rotor.mass = 1e9;
    const double gain = 20;      // rad/s2
    const double distance = 0.3; // rad
    model::Case scene = planar(rotor, 0, 0);
    balls_of(scene.rotor.balancers[0]).walls = {-2, pi - 2};
    balls_of(scene.rotor.balancers[0]).restitution = 0.6;
    scene.simulate.time = 1.5;
    scene.simulate.run_up = {{0, 100}, {1.5, 130}};
    scene.simulate.ball_angles = {{-2 + beside + distance, pi - 2 + beside + distance}};
    const results::SimulateResult result = analyses::simulate_alone(scene);
    const double first = std::sqrt(2 * distance / gain);
    for (std::size_t k = 0; k < result.series.time.size(); ++k) {
        double t = result.series.time[k];
        double height = distance - gain * t * t / 2;
        double speed = gain * first;
        if (t > first) {
            for (t -= first, height = 0; speed > 1e-6; t -= 2 * speed / gain) {
                speed *= 0.6;
                if (t >= 2 * speed / gain)
                    continue;
                height = speed * t - gain * t * t / 2;
                break;
            }
        }
        // Bounces slower than 1e-5 of the fastest speed are none: 4e-8 rad high.
        EXPECT_NEAR(result.series.angles[0][k], -2 + beside + height, 1e-7);
        EXPECT_NEAR(result.series.angles[1][k], pi - 2 + beside + height, 1e-7);
    }
    EXPECT_GT(*result.impacts, 20);
    EXPECT_LT(std::abs(result.audit.energy_error), 1e-8 * result.audit.energy_scale);
    EXPECT_LT(std::abs(result.audit.momentum_error), 1e-8 * result.audit.momentum_scale);
}

// Without their wall both balls would go to where they balance; one is stopped on its way, and the
// other goes where its push along the race vanishes.
TEST(Walls, BallsRestAgainstThem) {
    const double speed = 700;
    const double imbalance = 3e-3;
    const double long_axis = 2; // beyond the wall
    const tests::RigidJeffcott rotor;
    for (const double ellipticity : {0.0, 2e-3}) {
        model::Case scene = planar(rotor, 0.5, imbalance);
        model::Balls &balls = balls_of(scene.rotor.balancers[0]);
        balls.walls = {pi / 2, -0.5};
        balls.restitution = 0.4;
        balls.ellipticity = ellipticity;
        balls.ellipticity_angle = long_axis;
        scene.speeds = model::SpeedRange{speed, speed, 1};
        scene.simulate.time = 4;
        scene.simulate.ball_angles = {{0.3, -1.5}}; // it would go beyond the wall at pi/2
        const results::SimulateResult result = analyses::simulate_alone(scene);
        const std::vector<double> &a = result.balancers.front().angles;
        const auto rho = [&](double angle) {
            return radius * (1 + ellipticity * std::cos(2 * (angle - long_axis)));
        };
        // Half its diameter beside the wall.
        EXPECT_NEAR(rho(a[0]) * std::sin(pi / 2 - a[0]), 0.01, 1e-10);
        const Complex D(rotor.kx - (rotor.mass + 2 * ball_mass) * speed * speed, rotor.c * speed);
        const Complex sum = ball_mass * (std::polar(rho(a[0]), a[0]) + std::polar(rho(a[1]), a[1]));
        const Complex w = speed * speed * (imbalance + sum) / D;
        EXPECT_NEAR(result.balancers.front().amplitude, std::abs(w), 1e-5 * std::abs(w));
        const auto push = [&](double angle) { // Re[conj(w + z) dz/da]
            const Complex out = std::polar(1.0, angle);
            const double slope = -2 * radius * ellipticity * std::sin(2 * (angle - long_axis));
            return std::real(std::conj(w + rho(angle) * out) * (slope + Complex(0, rho(angle))) *
                             out);
        };
        EXPECT_GT(push(a[0]), 0); // towards the wall before it
        EXPECT_LT(std::abs(push(a[1])), 1e-4 * std::abs(push(a[0])));
    }
}

TEST(Walls, KeepEnergyMomentumAndTheirSides) {
    model::Case scene = tests::flexible_rotor(200);
    scene.rotor.balancers[0].imbalance_phase = 1;
    const std::vector<std::vector<double>> walls{{0, 2, 4}, {0.2, -1.2}};
    for (std::size_t i = 0; i < 2; ++i) {
        model::Balls &balls = balls_of(scene.rotor.balancers[i]);
        balls.walls = walls[i];
        balls.restitution = 0.4;
        balls.rows.front().diameter = 0.012;
        balls.eccentricity = 1e-3;
        balls.ellipticity = 0.03;
    }
    scene.simulate.gravity = 9.81;
    scene.simulate.run_up = {{0, 50}, {0.3, 400}};
    scene.simulate.ball_angles = {{0.5, 2.5, -2.0}, {1.0, -1.5}};
    for (const bool round : {false, true}) {
        for (std::size_t i = 0; round && i < 2; ++i) { // and balls that meet each other
            balls_of(scene.rotor.balancers[i]).ellipticity = 0;
            balls_of(scene.rotor.balancers[i]).contact = true;
        }
        const results::SimulateResult result = analyses::simulate_alone(scene);
        EXPECT_GT(*result.impacts, 10);
        EXPECT_LT(result.audit.impact_gain, 1e-12);
        EXPECT_LT(std::abs(result.audit.energy_error), 1e-6 * result.audit.energy_scale);
        EXPECT_LT(std::abs(result.audit.momentum_error), 1e-6 * result.audit.momentum_scale);
        std::size_t coordinate = 0;
        for (std::size_t i = 0; i < 2; ++i)
            for (const double start : scene.simulate.ball_angles[i]) {
                const std::vector<double> &angles = result.series.angles[coordinate++];
                for (const double wall : walls[i]) {
                    const double turns = std::floor((start - wall) / (2 * pi));
                    const auto [least, most] = std::ranges::minmax(angles);
                    EXPECT_GT(least, wall + 2 * pi * turns);
                    EXPECT_LT(most, wall + 2 * pi * (turns + 1));
                }
            }
    }
}

// Friction is too weak to take a ball along: the wall behind it does.
TEST(Walls, HoldBallsThatResistRolling) {
    model::Case scene = planar({}, 0, 0);
    model::Balls &balls = balls_of(scene.rotor.balancers[0]);
    balls.walls = {1, 1 + pi};
    balls.restitution = 0.4;
    balls.rows.front().rolling = 1e-5; // friction mu = 2e-5/0.02 = 1e-3
    scene.simulate.time = 0.5;
    scene.simulate.run_up = {{0, 100}, {0.5, 150}}; // 100 rad/s2 against mu W^2 = 10 to 23
    scene.simulate.ball_angles = {{1 + beside + 0.1, 1 + pi + beside + 0.1}};
    const results::SimulateResult result = analyses::simulate_alone(scene);
    EXPECT_NEAR(result.series.angles[0].back(), 1 + beside, 1e-9);
    EXPECT_LT(std::abs(result.audit.energy_error), 1e-6 * result.audit.energy_scale);
    EXPECT_LT(std::abs(result.audit.momentum_error), 1e-6 * result.audit.momentum_scale);
}

TEST(Walls, WhatTheyMakeImpossibleIsRefused) {
    model::Case scene = planar({}, 0.5, 3e-3);
    balls_of(scene.rotor.balancers[0]).walls = {1};
    scene.speeds = model::SpeedRange{700, 700, 1};
    scene.simulate.time = 1;
    EXPECT_THROW((void)analyses::stability(scene, {}), model::AnalysisFailure);
    EXPECT_NO_THROW((void)states::StateSearch(scene, 700, 700));
    model::Case touching = scene;
    balls_of(touching.rotor.balancers[0]).contact = true;
    EXPECT_THROW((void)states::StateSearch(touching, 700, 700), model::AnalysisFailure);
    const auto expect = [](const model::Case &one, const std::string &text) {
        try {
            (void)analyses::simulate_alone(one);
            ADD_FAILURE() << text;
        } catch (const model::BadInput &mistake) {
            EXPECT_NE(std::string(mistake.what()).find(text), std::string::npos) << mistake.what();
        }
    };
    scene.simulate.ball_angles = {{1.05, 2}};
    expect(scene, "simulate.ball_angles: expected balls beside the walls");
    model::Case usual = scene;
    usual.simulate.ball_angles.clear();
    balls_of(usual.rotor.balancers[0]).walls = {pi / 2};
    expect(usual, "simulate.ball_angles: missing");
    scene.simulate.ball_angles = {{1 + 1.001 * beside, 2}};
    EXPECT_NO_THROW((void)analyses::simulate_alone(scene));
}

// A motion goes on with the same balls alone.
TEST(Walls, BelongToTheRotorOfARestart) {
    model::Case scene = planar({}, 0.5, 3e-3);
    balls_of(scene.rotor.balancers[0]).walls = {1};
    scene.speeds = model::SpeedRange{700, 700, 1};
    scene.simulate.time = 1;
    const simulation::MotionScene prepared = simulation::motion_scene(scene);
    const simulation::RotorMotion motion(prepared.parts);
    const Eigen::VectorXd state = Eigen::VectorXd::Zero(motion.size());
    const auto signature = [&](const std::function<void(model::Balls &)> &change) {
        model::Rotor other = scene.rotor;
        change(balls_of(other.balancers[0]));
        return simulation::restart_of(other, motion, state.data(), {}).signature;
    };
    const auto own = signature([](model::Balls &) {});
    EXPECT_EQ(own, signature([](model::Balls &) {}));
    EXPECT_NE(own, signature([](model::Balls &balls) { balls.restitution = 0.3; }));
    EXPECT_NE(own, signature([](model::Balls &balls) { balls.rows[0].diameter = 0.021; }));
    EXPECT_NE(own, signature([](model::Balls &balls) { balls.walls[0] = 1.1; }));
    EXPECT_NE(own, signature([](model::Balls &balls) { balls.tilt = 0.01; }));
}

TEST(Walls, MistakesAreNamed) {
    const auto expect = [](const std::string &keys, const std::string &key,
                           const std::string &text) {
        try {
            (void)tests::written_case(
                "[shaft]\nsegments = [{length = 1, outer = 0.05, material = \"s\"}]\n"
                "[[bearing]]\nz = 0\nk = 1e7\nc = 100\n[[bearing]]\nz = 1\nk = "
                "1e7\nc = 100\n"
                "[[balancer]]\nz = 0.5\nmass = 0.01\nradius = 0.1\n" +
                keys);
            ADD_FAILURE() << "accepted: " << keys;
        } catch (const model::BadInput &mistake) {
            EXPECT_NE(std::string(mistake.what()).find(key), std::string::npos) << mistake.what();
            EXPECT_NE(std::string(mistake.what()).find(text), std::string::npos) << mistake.what();
        }
    };
    expect("walls = []\n", "balancer[0].walls", "at least one angle");
    try { // and no more than that
        (void)tests::written_case("[shaft]\nsegments = [{length = 1, outer = 0.05, material = "
                                  "\"s\"}]\n[[bearing]]\nz = 0\nk = 1e7\nc = 100\n"
                                  "[[bearing]]\nz = 1\nk = 1e7\nc = 100\n[[balancer]]\n"
                                  "z = 0.5\nmass = 0.01\nradius = 0.1\nwalls = []\n"
                                  "restitution = 0.5\n");
        ADD_FAILURE() << "accepted";
    } catch (const model::BadInput &mistake) {
        EXPECT_EQ(std::string(mistake.what()).find("restitution"), std::string::npos)
            << mistake.what();
    }
    try { // one mistake is told once
        (void)tests::written_case("[shaft]\nsegments = [{length = 1, outer = 0.05, material = "
                                  "\"s\"}]\n[[bearing]]\nz = 0\nk = 1e7\nc = 100\n"
                                  "[[bearing]]\nz = 1\nk = 1e7\nc = 100\n[[balancer]]\n"
                                  "z = 0.5\nmass = 0.01\nradius = 0.1\nwalls = 0.5\n");
        ADD_FAILURE() << "accepted";
    } catch (const model::BadInput &mistake) {
        const std::string text = mistake.what();
        EXPECT_EQ(text.find("balancer[0].walls"), text.rfind("balancer[0].walls")) << text;
    }
    // Nobody asks where one ball between walls would balance.
    EXPECT_NO_THROW((void)tests::written_case(
        "[shaft]\nsegments = [{length = 1, outer = 0.05, material = \"s\"}]\n[[bearing]]\nz = "
        "0\nk = 1e7\nc = 100\n[[bearing]]\nz = 1\nk = 1e7\nc = 100\n[[balancer]]\nz = "
        "0.5\nmass = 0.01\nradius = 0.1\nn = 1\nimbalance = 0.01\nwalls = [1]\n"));
    expect("walls = [0.5, \"30 deg\", \"390 deg\"]\n", "balancer[0].walls", "angles of their own");
    expect("restitution = 0.5\n", "balancer[0].restitution", "or walls");
    expect("walls = [1]\nrelease_speed = 10\n", "balancer[0].release_speed", "no walls");
    expect("walls = [1]\nheld = true\n", "balancer[0].held", "with walls");
    expect("walls = [1]\n[simulate]\ntime = 1\ntorque = 1\n", "simulate.torque", "meet walls");
}

} // namespace
} // namespace whirl::walls
