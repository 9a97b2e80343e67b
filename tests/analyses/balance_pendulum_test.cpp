// Four-pendulum balancers on rigid and flexible rotors.

#include "analyses/balance.h"
#include "analyses/stability.h"
#include "closed_form/pendulum_branches.h"
#include "closed_form/pendulum_small_motions.h"
#include "criterion/pendulum_motion.h"
#include "forced/forced_motion.h"
#include "input/case_file.h"
#include "model/errors.h"
#include "results/formulation.h"
#include "support/balancer_parts.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>

namespace {

using namespace whirl;
using results::PendulumBalance;

model::Balancer pendulum_at(double z, double imbalance, double hinge = 0) {
    model::Balancer balancer;
    balancer.z = z;
    tests::pendulums_of(balancer).mass = 1;
    tests::pendulums_of(balancer).arm = 0.18;
    tests::pendulums_of(balancer).pivot = 0.02;
    tests::pendulums_of(balancer).damping = hinge;
    balancer.imbalance = imbalance;
    return balancer;
}

/// The planar rotor of the paper's first figure, 5 kg in the middle of a shaft without mass.
model::Case figure_scene(double c, double hinge, double imbalance) {
    model::Case scene;
    scene.rotor.shaft = tests::uniform_shaft(0.4, 0.04, tests::weightless_steel());
    scene.rotor.shaft.rigid = true;
    scene.rotor.discs = {tests::disc_at(0.2, 5, 0.03, 0.05)};
    scene.rotor.bearings = {tests::isotropic_bearing(0, 2e5, c),
                            tests::isotropic_bearing(0.4, 2e5, c)};
    scene.rotor.balancers = {pendulum_at(0.2, imbalance, hinge)};
    scene.speeds = model::SpeedRange{21, 840, 40};
    return scene;
}

const double omega_0 = std::sqrt(4e5 / 9);

TEST(BalancePendulum, RigidSymmetricRotorIsThePlanarOne) {
    const double H2 = 2 * 50;
    const double H1 = 2;
    const auto result = analyses::balance(figure_scene(50, H1, 0.02));
    const PendulumBalance &found = result.pendulum.at(0);
    closed_form::PendulumRotor planar = closed_form::pendulum_rotor(5, 1, 0.18, 0.02);
    planar.external_damping = H2 / (9 * omega_0);
    planar.hinge_damping = H1 / (0.18 * 0.18 * omega_0);
    planar.imbalance = 0.02 / (2 * 0.18);
    EXPECT_NEAR(found.rho, 2, 1e-9);
    EXPECT_NEAR(found.threshold, std::sqrt(0.5), 1e-9);
    EXPECT_NEAR(found.limit, 1.0 / 3, 1e-9);
    EXPECT_NEAR(found.omega_0 / omega_0, 1, 1e-9);
    EXPECT_NEAR(found.external_damping / planar.external_damping, 1, 1e-9);
    EXPECT_NEAR(found.hinge_damping / planar.hinge_damping, 1, 1e-9);
    int several = 0;
    for (std::size_t k = 0; k < found.speeds.size(); ++k) {
        const double ratio = found.speeds[k] / omega_0;
        EXPECT_NEAR(found.approximate[k], closed_form::approximate_efficiency(planar, ratio), 1e-8);
        const auto motions = closed_form::steady_motions(planar, ratio);
        ASSERT_EQ(found.states[k].size(), motions.size()) << ratio;
        several += motions.size() > 1 ? 1 : 0;
        for (std::size_t i = 0; i < motions.size(); ++i) {
            const auto &state = found.states[k][i];
            EXPECT_NEAR(state.ratio / closed_form::exact_efficiency(planar, motions[i], ratio), 1,
                        1e-8);
            EXPECT_NEAR(state.phi, motions[i].phi, 1e-8);
            EXPECT_NEAR(state.psi, motions[i].psi, 1e-8);
            EXPECT_EQ(state.collision, !closed_form::valid(motions[i]));
            // Tilt adds damped motions of its own: the growth may only be larger by them.
            EXPECT_NEAR(std::max(0.0, state.growth), std::max(0.0, omega_0 * motions[i].growth),
                        1e-6 * omega_0);
        }
    }
    EXPECT_GT(several, 0); // there were speeds with more than one steady motion
}

TEST(BalancePendulum, UndampedRangeOfInstability) {
    // theory.md 5.4: unstable for 0.72 < R < 2.52, digits printed; small imbalance.
    const auto result = [](double ratio) {
        model::Case scene = figure_scene(0, 0, 1e-6);
        scene.speeds = model::SpeedRange{ratio * omega_0, 0, 1};
        return analyses::balance(scene).pendulum.at(0).states.at(0).front().stable;
    };
    EXPECT_TRUE(result(0.70));
    EXPECT_FALSE(result(0.74));
    EXPECT_FALSE(result(2.50));
    EXPECT_TRUE(result(2.54));
}

/// Two pendulum balancers away from the middle of a flexible rotor.
struct FlexibleScene {
    model::Rotor rotor;
    std::vector<balancers::PlacedPendulums> pendulums;
    std::vector<model::Imbalance> drive{tests::imbalance_at(0.3, 0.03, 0.4),
                                        tests::imbalance_at(0.6, 0.02, 2.0)};
    FlexibleScene() {
        model::Rotor placed;
        placed.balancers = {pendulum_at(0.3, 0, 3), pendulum_at(0.8, 0, 3)};
        pendulums = balancers::pendulums_in(placed);
        rotor.shaft = tests::uniform_shaft(1, 0.05, tests::steel());
        rotor.shaft.segments[0].elements = 2;
        rotor.discs = {tests::disc_at(0.4, 15, 0.1, 0.18)};
        rotor.bearings = {tests::isotropic_bearing(0, 1e6, 2e3),
                          tests::isotropic_bearing(1, 2e6, 2e3)};
    }
};

TEST(BalancePendulum, SteadyMotionIsTheResponseToTheForcesOfItsPendulums) {
    const FlexibleScene scene;
    criterion::PendulumShaft shaft(scene.rotor, 4, scene.pendulums, scene.drive);
    for (const double speed : {60.0, 250.0, 500.0}) {
        const auto motions = shaft.motions(speed, {});
        ASSERT_FALSE(motions.empty()) << speed;
        for (const auto &motion : motions) {
            model::Rotor rotor = shaft.rotor().rotor(); // with the rings of the pendulums
            rotor.imbalances = scene.drive;
            for (Eigen::Index j = 0; j < 2; ++j) {
                // -2 m l (sin psi - i sin phi) turns with the rotor.
                const std::complex<double> force =
                    -2.0 * 0.18 *
                    std::complex<double>(std::sin(motion.psi(j)), -std::sin(motion.phi(j)));
                rotor.imbalances.push_back(
                    tests::imbalance_at(scene.pendulums[static_cast<std::size_t>(j)].z,
                                        std::abs(force), std::arg(force)));
            }
            const assembly::Discretization d(rotor, 4);
            forced::ForcedMotion response(d, results::Form::planar);
            response.solve(speed);
            for (Eigen::Index j = 0; j < 2; ++j) {
                const std::complex<double> u =
                    response.motion(d.deflection_at(scene.pendulums[static_cast<std::size_t>(j)].z))
                        .x;
                EXPECT_LT(std::abs(u - motion.deflection(j)), 1e-8 * std::abs(u)) << speed;
                EXPECT_NEAR(0.02 * std::tan(motion.phi(j)), u.imag(), 1e-8 * std::abs(u));
                EXPECT_NEAR(0.02 * std::tan(motion.psi(j)), -u.real(), 1e-8 * std::abs(u));
            }
        }
    }
}

TEST(BalancePendulum, StabilityDoesNotDependOnHowManyModesAreKept) {
    const FlexibleScene scene;
    criterion::PendulumShaft shaft(scene.rotor, 4, scene.pendulums, scene.drive);
    const criterion::PendulumStability few(shaft, 0, 8);
    const criterion::PendulumStability many(shaft, 0, 16);
    int growing = 0;
    for (const double speed : {60.0, 250.0, 500.0})
        for (const auto &motion : shaft.motions(speed, {})) {
            const double growth = many.growth(speed, motion);
            growing += growth > 1 ? 1 : 0;
            EXPECT_NEAR(few.growth(speed, motion), growth, 1e-3 * (std::abs(growth) + 1)) << speed;
        }
    EXPECT_GT(growing, 0);
}

// Shaft motions that creep against strong internal damping stand beside fast ones in one matrix.
// What grows is told by the whole rotor's motions in rotating axes, an equation of its own.
TEST(BalancePendulum, StrongInternalDampingIsSolved) {
    const model::Case scene = input::load_case(
        WHIRL_ROOT "/cases/pendulum_centrifuge",
        {"bearing[0].k=13729.6", "bearing[1].k=476285", "bearing[1].c=27557.3",
         "disc[0].mass=358.496", "shaft.internal_damping=0.00408079", "speeds.count=7"});
    const auto states = analyses::balance(scene).pendulum.at(0).states;
    const std::vector<double> growth = analyses::stability(scene, {}).growth;
    ASSERT_EQ(states.size(), growth.size());
    for (std::size_t i = 0; i < growth.size(); ++i) {
        ASSERT_FALSE(states[i].empty());
        EXPECT_EQ(states[i].front().stable, growth[i] < 0) << i;
    }
}

TEST(BalancePendulum, PivotOnTheAxisIsRefused) {
    model::Case scene = figure_scene(300, 2, 0.05);
    tests::pendulums_of(scene.rotor.balancers[0]).pivot = 0;
    EXPECT_THROW((void)analyses::balance(scene), model::BadInput);
}

} // namespace
