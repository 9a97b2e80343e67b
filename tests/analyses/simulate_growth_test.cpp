// Motions whose growth is known from eigenvalues, and the same motions in other units.

#include "analyses/simulate.h"

#include "simulation/linear_growth.h"
#include "support/balancer_scenes.h"
#include "support/scaled_units.h"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

namespace whirl::analyses {
namespace {

model::Segment round_bar(double length, double diameter) {
    const model::Material steel{"steel", 2.1e11, 2.1e11 / 2.6, 7850};
    return {length, diameter, diameter, 0, 0, steel, 1};
}

/// A rotor whose third bearing, at the thin end, is a seal that drives forward whirl.
model::Case driven_rotor(double time) {
    model::Case scene;
    scene.rotor.shaft.segments = {round_bar(1, 0.06), round_bar(0.6, 0.03)};
    scene.rotor.discs = {tests::disc_at(0.5, 20, 0.2, 0.3), tests::disc_at(1.6, 3, 0.005, 0.008)};
    scene.rotor.bearings = {tests::isotropic_bearing(0, 5e6, 2000),
                            tests::isotropic_bearing(1, 5e6, 2000),
                            tests::isotropic_bearing(1.6, 0, 5)};
    scene.rotor.bearings[2].rows[0].k << 0, 4000, -4000, 0;
    scene.rotor.balancers = {tests::ball_balancer(0.5, 2, 0.05, 0.1, 0.3, 0.006)};
    scene.speeds = model::SpeedRange{600, 600, 1};
    scene.simulate.time = time;
    scene.simulate.ball_angles = {{2, -2.2}};
    return scene;
}

/// Largest real part for the balanced position, from a dense solution in rotating axes by a program
/// of its own (numpy, two-node elements): 2.20397764 with 160 of them, 2.20397727 with 320.
constexpr double growth = 2.203977;

TEST(SimulateGrowth, is_that_of_the_eigenvalue) {
    const std::optional<double> found =
        simulation::linear_growth(driven_rotor(1), 600, {{1.9, -1.9}});
    ASSERT_TRUE(found);
    EXPECT_NEAR(*found, growth, 2e-6); // digits of the source
    for (const double time : {2.0, 3.0, 5.0}) {
        const results::SimulateResult result = simulate(driven_rotor(time));
        EXPECT_EQ(result.outcome, results::Outcome::growing) << time << " s: " << result.evidence;
        ASSERT_TRUE(result.trend);
        // Early on what else dies out is still in the amplitude.
        EXPECT_NEAR(*result.trend / growth, 1, time < 3 ? 0.02 : 1e-3) << time;
        ASSERT_TRUE(result.linear_growth) << time;
        EXPECT_NEAR(*result.linear_growth, growth, 2e-6);
    }
}

TEST(SimulateGrowth, is_not_called_balanced_before_it_shows) {
    // Later it is seen growing at the seal, where the balancer feels nothing of it yet.
    const results::SimulateResult result = simulate(driven_rotor(0.2));
    EXPECT_EQ(result.outcome, results::Outcome::undecided) << result.evidence;
    ASSERT_TRUE(result.decision_time);
    EXPECT_NEAR(*result.decision_time, 0.2 + std::log(1e8) / growth, 1e-4);
    EXPECT_EQ(simulate(driven_rotor(1)).outcome, results::Outcome::growing);
}

TEST(SimulateGrowth, beyond_all_numbers_is_growing_too) {
    const results::SimulateResult result = simulate(driven_rotor(8));
    EXPECT_EQ(result.outcome, results::Outcome::growing) << result.evidence;
    EXPECT_LT(result.time, 8);
    EXPECT_FALSE(result.model.notes.empty());
}

TEST(SimulateGrowth, without_the_seal_it_balances) {
    model::Case scene = driven_rotor(6);
    scene.rotor.bearings[2].rows[0].k.setZero();
    const results::SimulateResult result = simulate(scene);
    EXPECT_EQ(result.outcome, results::Outcome::balanced) << result.evidence;
    ASSERT_TRUE(result.linear_growth);
    EXPECT_LE(*result.linear_growth, 0);
    EXPECT_FALSE(result.decision_time);
}

TEST(SimulateUnits, other_units_give_the_same_motion) {
    model::Case driven = driven_rotor(0.2);
    driven.simulate.gravity = 9.81;
    for (const model::Case &scene : {driven, tests::rodrigues_rotor(4, .01, .005)}) {
        model::Case short_one = scene;
        short_one.simulate.time = scene.simulate.time / 10;
        const results::SimulateResult expected = simulate(short_one);
        for (const auto &[length, mass, time] : {std::tuple(-20, 0, 0),
                                                 {20, 0, 0},
                                                 {0, -20, 0},
                                                 {0, 20, 0},
                                                 {0, 0, -20},
                                                 {0, 0, 20}}) {
            const tests::Units u{std::ldexp(1.0, length), std::ldexp(1.0, mass),
                                 std::ldexp(1.0, time)};
            const results::SimulateResult result = simulate(tests::scaled(short_one, u));
            const std::string where =
                std::to_string(length) + " " + std::to_string(mass) + " " + std::to_string(time);
            EXPECT_EQ(result.outcome, expected.outcome) << where;
            EXPECT_EQ(result.shapes, expected.shapes) << where;
            EXPECT_EQ(result.model.notes, expected.model.notes) << where;
            for (std::size_t i = 0; i < expected.balancers.size(); ++i) {
                const results::BalancerMotion &a = expected.balancers[i];
                const results::BalancerMotion &b = result.balancers[i];
                // Both follow the motion to the tolerance of the integrator, which gathers.
                EXPECT_NEAR(b.amplitude / (a.amplitude * u.length), 1, 1e-5) << where;
                EXPECT_NEAR(b.reference / (a.reference * u.length), 1, 1e-9) << where;
                for (std::size_t j = 0; j < a.angles.size(); ++j)
                    EXPECT_NEAR(b.angles[j], a.angles[j], 1e-5) << where;
            }
            EXPECT_EQ(result.linear_growth.has_value(), expected.linear_growth.has_value());
            if (expected.linear_growth && result.linear_growth) {
                EXPECT_NEAR(*result.linear_growth * u.time / *expected.linear_growth, 1, 1e-6);
            }
        }
    }
}

} // namespace
} // namespace whirl::analyses
