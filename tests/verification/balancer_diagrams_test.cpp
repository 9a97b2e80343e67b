// Published stability diagrams of two-plane ball balancers, and the motions in time behind them:
// J. Rodrigues et al., and numbers computed independently from their equations (shared reference
// data). Lengths in ball radii, masses in rotor masses, time in 1/Omega_1.

#include "analyses/arrangement.h"
#include "analyses/balancer_scenes.h"
#include "analyses/motions.h"
#include "analyses/simulate.h"
#include "analyses/stability.h"
#include "closed_form/pendulum_balancer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

namespace {

using namespace whirl;

constexpr double quarter = std::numbers::pi / 2;

/// The rotor's imbalance: eccentricity at the phase beta = 1 against the tilt of its principal
/// axis.
struct Imbalance {
    double eccentricity = 0; ///< eps
    double tilt = 0;         ///< chi, rad
    double phase = 0;        ///< beta, rad
};

/// What the race at z, one of two at +-z, has to balance: half of the static part, and half of the
/// couple chi (Jt - Jp) over z.
std::complex<double> share_of(const Imbalance &imbalance, double z) {
    constexpr double Jt = 3.25;
    constexpr double Jp = 0.5;
    return 0.5 * (std::polar(imbalance.eccentricity, imbalance.phase) +
                  imbalance.tilt * (Jt - Jp) / z);
}

model::Case rotor_with(const Imbalance &imbalance, double ball_mass, double race_damping) {
    model::Case scene = tests::rodrigues_rotor(1, imbalance.eccentricity, ball_mass);
    scene.rotor.imbalances.clear();
    double z = -2;
    for (model::Balancer &balancer : scene.rotor.balancers) {
        const std::complex<double> share = share_of(imbalance, z);
        balancer.imbalance = std::abs(share);
        balancer.imbalance_phase = std::arg(share);
        balancer.damping = race_damping * ball_mass;
        balancer.tilt_inertia = false;
        z = 2;
    }
    return scene;
}

model::Case static_rotor(double eccentricity, double ball_mass) {
    return rotor_with({eccentricity, 0, 0}, ball_mass, 0.01);
}

/// eps = chi = half of the ball mass, beta = 1.
model::Case dynamic_rotor(double ball_mass, double race_damping) {
    return rotor_with({ball_mass / 2, ball_mass / 2, 1}, ball_mass, race_damping);
}

/// The speed above which the balanced position is stable up to `to`.
double stable_above(model::Case scene, double from, double to) {
    scene.speeds = model::SpeedRange{from, to, 81};
    const auto bands = analyses::unstable_bands_of(scene, scene.rotor,
                                                   analyses::arrangement_at_balance(scene.rotor));
    return bands.empty() ? from : bands.back().second;
}

// The balls' angles take up the couple as well: the position balances both planes' phases.
TEST(TwoPlaneDiagram, BalancedPositionTakesUpStaticPartAndCouple) {
    const model::Case scene = dynamic_rotor(.01, .01);
    const analyses::Arrangement balls = analyses::arrangement_at_balance(scene.rotor);
    std::complex<double> force = std::polar(.005, 1.0);
    std::complex<double> couple = .005 * (3.25 - .5);
    for (std::size_t i = 0; i < 2; ++i)
        for (const double angle : balls[i]) {
            force += std::polar(.01, angle);
            couple += (i == 0 ? -2 : 2) * std::polar(.01, angle);
        }
    EXPECT_LT(std::abs(force), 1e-15);
    EXPECT_LT(std::abs(couple), 1e-15);
}

// Four digits are printed.
TEST(TwoPlaneDiagram, HopfBoundsForDynamicImbalance) {
    EXPECT_NEAR(stable_above(dynamic_rotor(.01, .01), 2, 6), 3.387, 6e-4);
    EXPECT_NEAR(stable_above(dynamic_rotor(.001, .01), 2, 6), 2.502, 6e-4);
    EXPECT_NEAR(stable_above(dynamic_rotor(.01, .1), 2, 6), 3.017, 6e-4);
}

// The published limit cycle at (3.386, period 7.081) is born at the bound: there the critical root
// swings with that period, but for what 0.001 of speed and the size of the cycle change.
TEST(TwoPlaneDiagram, LimitCycleIsBornAtTheBound) {
    const model::Case scene = dynamic_rotor(.01, .01);
    const analyses::MotionSolver solver(scene.rotor, analyses::Form::rotating, 1,
                                        analyses::arrangement_at_balance(scene.rotor), 0);
    const auto motions = solver.at(3.386);
    const auto critical =
        std::max_element(motions.begin(), motions.end(), [](const auto &a, const auto &b) {
            return a.eigenvalue.real() < b.eigenvalue.real();
        });
    ASSERT_NE(critical, motions.end());
    EXPECT_GT(critical->eigenvalue.real(), 0);
    EXPECT_LT(critical->eigenvalue.real(), 1e-4);
    EXPECT_NEAR(2 * std::numbers::pi / std::abs(critical->eigenvalue.imag()), 7.081, 0.01);
}

// Coupled supports K = [1 3; 3 45]: springs 1/2 at 3 to the left and 9 to the right of the centre.
TEST(TwoPlaneDiagram, CoupledSupports) {
    model::Case scene = static_rotor(.001, .001);
    scene.rotor.shaft = tests::uniform_shaft(14, 0.01, tests::weightless_steel());
    scene.rotor.shaft.rigid = true;
    scene.rotor.bearings = {tests::isotropic_bearing(1, 0.5, 0.01),
                            tests::isotropic_bearing(13, 0.5, 0.01)};
    EXPECT_NEAR(stable_above(scene, 3, 9), 6.589, 6e-4);
}

/// Supports KX = diag(1, 9), KY = diag(5, 45), C = 0.02 K; m = eps = 1e-4.
double growth_on_anisotropic_supports(double speed) {
    model::Case scene = static_rotor(1e-4, 1e-4);
    for (model::Bearing &bearing : scene.rotor.bearings) {
        bearing.rows[0].k << 0.5, 0, 0, 2.5;
        bearing.rows[0].c = 0.02 * bearing.rows[0].k;
    }
    const analyses::MotionSolver solver(scene.rotor, analyses::Form::hill, 1,
                                        analyses::arrangement_at_balance(scene.rotor), 6);
    return analyses::growth_of(solver.at(speed));
}

// Floquet multipliers of the published equations on a grid of 0.05: stable in 2.50 ... 2.70 and
// from 4.55 on.
TEST(TwoPlaneDiagram, WindowsOnAnisotropicSupports) {
    for (const double speed : {2.5, 2.6, 2.7, 4.55, 5.0, 5.5, 6.0})
        EXPECT_LT(growth_on_anisotropic_supports(speed), 0) << speed;
    for (const double speed : {0.8, 1.5, 2.0, 2.45, 2.75, 3.0, 3.5, 4.0, 4.5})
        EXPECT_GT(growth_on_anisotropic_supports(speed), 0) << speed;
}

// Above the bound 2.933 of the smaller ball mass the same speed is bistable with a greater one:
// the start decides.
TEST(TwoPlaneMotion, BistablePointDependsOnTheStart) {
    model::Case scene = tests::rodrigues_rotor(2, .01, .025);
    scene.simulate.time = 1500;
    scene.simulate.other_starts = {{{0, 0.3}, {0, -0.2}}};
    const auto result = analyses::simulate(scene);
    EXPECT_EQ(result.outcome, analyses::Outcome::balanced) << result.evidence;
    ASSERT_EQ(result.other_starts.size(), 1U);
    EXPECT_NE(result.other_starts[0].outcome, analyses::Outcome::balanced)
        << result.other_starts[0].evidence;
    EXPECT_GT(*result.other_starts[0].residual_ratio, 1);
}

} // namespace
