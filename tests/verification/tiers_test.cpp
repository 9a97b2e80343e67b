// Three tiers of evidence about the same rotors: the criterion (balancers without mass), the
// eigenvalues of the balanced position with the real balls, and the motion in time.

#include "analyses/balance.h"
#include "analyses/simulate.h"
#include "analyses/stability.h"
#include "balancers/arrangement.h"
#include "ends/growth.h"
#include "results/formulation.h"
#include "support/balancer_scenes.h"
#include "support/looked_at.h"
#include "two_plane_rotor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

using namespace whirl;
using tests::stable_above;

/// The rotor of Rodrigues et al. with a static eccentricity, which each of the two races balances
/// by half; without the balls' inertia against tilting, which the equations of 2008 contain and
/// those of later papers leave out.
model::Case published_rotor(double eccentricity, double ball_mass) {
    return tests::rotor_with({eccentricity, 0, 0}, ball_mass, 0.01);
}

double growth_at(const model::Case &scene, double speed) {
    return ends::Growth(tests::looked_at(scene.rotor, results::Form::rotating, 1),
                        balancers::arrangement_at_balance(scene.rotor), {speed})
        .at(speed);
}

// Hopf bounds computed from the later equations, four digits printed.
TEST(BalancedPosition, HopfBoundsOfTheTwoPlaneBalancer) {
    EXPECT_NEAR(stable_above(published_rotor(.01, .003), 2, 6), 2.732, 6e-4);
    EXPECT_NEAR(stable_above(published_rotor(.01, .005), 2, 6), 2.933, 6e-4);
    EXPECT_NEAR(stable_above(published_rotor(.01, .01), 2, 6), 3.504, 6e-4);
    EXPECT_NEAR(stable_above(published_rotor(.001, .001), 2, 6), 2.481, 6e-4);
}

// The balls' own inertia against tilting moves the bound 2.933 to 2.944.
TEST(BalancedPosition, TiltInertiaOfTheBallsShiftsTheBound) {
    model::Case scene = published_rotor(.01, .005);
    for (model::Balancer &balancer : scene.rotor.balancers)
        balancer.tilt_inertia = true;
    EXPECT_NEAR(stable_above(scene, 2, 6), 2.944, 6e-4);
}

// Three Hopf points over the ball mass at speed 3: .0034, .0038, .0054.
TEST(BalancedPosition, ThreeHopfPointsOverTheBallMass) {
    EXPECT_LT(growth_at(published_rotor(.01, .0033), 3), 0);
    EXPECT_GT(growth_at(published_rotor(.01, .0036), 3), 0);
    EXPECT_LT(growth_at(published_rotor(.01, .0046), 3), 0);
    EXPECT_GT(growth_at(published_rotor(.01, .0056), 3), 0);
}

TEST(BalancedPosition, NeverStableOnADiscTypeRotor) {
    model::Case scene = published_rotor(.001, .001);
    scene.rotor.discs[0].Id = 0.5;
    scene.rotor.discs[0].Ip = 0.9;
    for (const double speed : {1.5, 2.0, 3.0, 5.0, 8.0})
        EXPECT_GT(growth_at(scene, speed), 0) << speed;
}

// Without damping in the bearings the drag of the balls, which turns with the rotor, drives it.
TEST(BalancedPosition, StableNowhereWithoutBearingDamping) {
    model::Case scene = published_rotor(.01, .01);
    for (model::Bearing &bearing : scene.rotor.bearings)
        bearing.rows[0].c.setZero();
    for (double speed = 0.5; speed < 6; speed += 0.25)
        EXPECT_GT(growth_at(scene, speed), 0) << speed;
}

/// One plane at z = 0.2 from the centre of a damped long rotor, balls of the given mass.
model::Case one_plane(double ball_mass) {
    model::Case scene;
    scene.rotor.shaft = tests::uniform_shaft(0.9, 0.01, tests::weightless_steel());
    scene.rotor.shaft.rigid = true;
    scene.rotor.discs = {tests::disc_at(0.4, 60, 3, 1)};
    scene.rotor.bearings = {tests::isotropic_bearing(0, 2e6, 200),
                            tests::isotropic_bearing(0.9, 3e6, 300)};
    scene.rotor.balancers = {
        tests::ball_balancer(0.6, 2, ball_mass, 0.1, 40 * ball_mass, 0.1 * ball_mass)};
    scene.speeds = model::SpeedRange{300, 650, 71};
    return scene;
}

// One plane: as the balls get lighter, the end of stability tends to the zero of the criterion.
TEST(Tiers, LighterBallsMeetTheCriterionInProportionToTheirMass) {
    const auto criterion = analyses::balance(one_plane(0.01)).planes.at(0).bands.bands;
    ASSERT_EQ(criterion.size(), 1U);
    std::vector<double> differences;
    for (const double mass : {0.02, 0.01, 0.005}) {
        const auto stable = analyses::balance(one_plane(mass)).balanced_position;
        ASSERT_TRUE(stable);
        ASSERT_EQ(stable->bands.size(), 1U);
        differences.push_back(std::abs(stable->bands[0].to - criterion[0].to));
    }
    for (std::size_t i = 1; i < differences.size(); ++i)
        EXPECT_NEAR(std::log2(differences[i - 1] / differences[i]), 1, 0.1);
    EXPECT_LT(differences.back(), 1); // rad/s, of some 470
}

/// A flexible two-disc rotor with two balls in a race beside each disc.
model::Case two_planes(double ball_mass) {
    model::Case scene;
    scene.rotor.shaft = tests::uniform_shaft(1.2, 0.09, tests::steel());
    scene.rotor.shaft.order = 3;
    scene.rotor.discs = {tests::disc_at(0.3, 25, 0.15, 0.25), tests::disc_at(0.9, 20, 0.12, 0.2)};
    scene.rotor.bearings = {tests::isotropic_bearing(0, 2e6, 200),
                            tests::isotropic_bearing(1.2, 2.5e6, 250)};
    for (const double z : {0.25, 0.95})
        scene.rotor.balancers.push_back(
            tests::ball_balancer(z, 2, ball_mass, 0.12, 40 * ball_mass, 0.12 * ball_mass));
    return scene;
}

// Two planes on a flexible rotor: the upper end of the joint band, which no rigid form has.
TEST(Tiers, UpperEndOfAFlexibleRotorIsMetInProportionToTheBallMass) {
    model::Case scene = two_planes(0.01);
    scene.balance.balanced_position = false;
    scene.speeds = model::SpeedRange{100, 4000, 200};
    const auto joint = analyses::balance(scene).joint.bands;
    ASSERT_FALSE(joint.ends.empty());
    const auto upper = std::find_if(joint.ends.begin(), joint.ends.end(),
                                    [](const results::BandEnd &end) { return end.upper; });
    ASSERT_NE(upper, joint.ends.end());
    std::vector<double> differences;
    for (const double mass : {0.04, 0.02, 0.01}) {
        model::Case real = two_planes(mass);
        real.speeds = model::SpeedRange{0.95 * upper->speed, 1.02 * upper->speed, 31};
        const auto stable = analyses::balance(real).balanced_position;
        ASSERT_TRUE(stable);
        ASSERT_EQ(stable->bands.size(), 1U) << mass;
        differences.push_back(std::abs(stable->bands[0].to - upper->speed));
    }
    for (std::size_t i = 1; i < differences.size(); ++i)
        EXPECT_NEAR(std::log2(differences[i - 1] / differences[i]), 1, 0.05);
    EXPECT_LT(differences.back(), 1e-3 * upper->speed);
}

// Forty and more points: where the eigenvalues say stable, a start beside the balanced position
// returns to it, where they say unstable it leaves. Points so near to an end that nothing happens
// within the longest run are left out.
TEST(Tiers, MotionInTimeDoesWhatTheEigenvaluesPromise) {
    int points = 0;
    for (const double mass : {.003, .005, .01, .02}) {
        for (double speed = 1.2; speed < 6; speed += 0.27) {
            model::Case scene = published_rotor(.01, mass);
            const double growth = growth_at(scene, speed);
            if (std::abs(growth) < 0.004)
                continue;
            scene.speeds = model::SpeedRange{speed, speed, 1};
            scene.simulate.time = 14 / std::abs(growth);
            scene.simulate.tolerance = 1e-7;
            scene.simulate.ball_angles = balancers::arrangement_at_balance(scene.rotor);
            scene.simulate.ball_angles[0][0] += 0.02;
            scene.simulate.ball_angles[1][1] += 0.01;
            const auto result = analyses::simulate(scene);
            EXPECT_EQ(result.outcome == results::Outcome::balanced, growth < 0)
                << "speed " << speed << ", ball mass " << mass << ", growth " << growth << ": "
                << result.evidence;
            ++points;
        }
    }
    EXPECT_GE(points, 40);
}

} // namespace
