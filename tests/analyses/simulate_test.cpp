// How motions end, against published outcomes and closed forms of steady motion.

#include "analyses/simulate.h"

#include "closed_form/pendulum_small_motions.h"
#include "model/errors.h"
#include "support/balancer_parts.h"
#include "support/balancer_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace whirl::analyses {
namespace {

using tests::pendulum_rotor_scene;
using tests::rodrigues_rotor;

double largest(const std::vector<double> &values, std::size_t from, std::size_t to) {
    return *std::max_element(values.begin() + static_cast<std::ptrdiff_t>(from),
                             values.begin() + static_cast<std::ptrdiff_t>(to));
}

struct Published {
    double speed, eccentricity, ball_mass;
    bool balances;
};

class TwoPlaneBalancer : public testing::TestWithParam<Published> {};

// Rodrigues et al., points of the stability diagram for static eccentricity.
TEST_P(TwoPlaneBalancer, EndsAsPublished) {
    const auto [speed, eccentricity, mass, balances] = GetParam();
    model::Case scene = rodrigues_rotor(speed, eccentricity, mass);
    scene.simulate.time = 1500;
    const results::SimulateResult result = simulate(scene);
    ASSERT_TRUE(result.residual_ratio);
    if (balances) {
        EXPECT_EQ(result.outcome, results::Outcome::balanced) << result.evidence;
        // Both balls of a plane take half of the imbalance: 2 m cos(angle) = -eccentricity / 2.
        const double expected = std::acos(-eccentricity / (4 * mass));
        for (const results::BalancerMotion &b : result.balancers)
            for (const double angle : b.angles)
                EXPECT_NEAR(std::abs(angle), expected, 2e-3); // what is left after this time
    } else {
        EXPECT_NE(result.outcome, results::Outcome::balanced) << result.evidence;
        EXPECT_GT(*result.residual_ratio, 1) << result.evidence;
    }
}

INSTANTIATE_TEST_SUITE_P(Points, TwoPlaneBalancer,
                         testing::Values(Published{2, .01, .025, true},
                                         Published{4, .01, .005, true},
                                         Published{2.5, .01, .005, false}));

// Mean amplitude one radius to either side of mid-span for the symmetric start at (4, .01, .005),
// computed by integration of the published equations: 2.1e-2 ... 6.0e-4 at t = 100 ... 600. The
// amplitude beats from one output to the next, so the decay is what can be compared: the largest
// value around each time, within a fifth.
TEST(TwoPlaneBalancerDecay, AsFastAsPublished) {
    model::Case scene = rodrigues_rotor(4, .01, .005);
    scene.simulate.ball_angles[0][0] -= 0.01;
    for (model::Balancer &b : scene.rotor.balancers)
        b.tilt_inertia = false; // as in the later equations, of which the decay is
    scene.simulate.time = 620;
    scene.simulate.output_points = 621;
    const results::SimulateResult result = simulate(scene);
    const std::vector<double> published{2.1e-2, 9.4e-3, 4.2e-3, 2.0e-3, 1.1e-3, 6.0e-4};
    for (std::size_t i = 0; i < published.size(); ++i) {
        const std::size_t at = 100 * (i + 1);
        const double amplitude = largest(result.series.amplitude[0], at - 10, at + 10);
        EXPECT_LT(std::abs(std::log(amplitude / published[i])), std::log(1.2)) << at;
        // The symmetric start moves both planes alike.
        EXPECT_NEAR(result.series.x[0][at], result.series.x[1][at], 1e-6 * amplitude);
    }
}

// Below the resonances balls gather on the heavy side: they stand still and make it worse.
TEST(TwoPlaneBalancerBelowResonance, IsOffset) {
    model::Case scene = rodrigues_rotor(0.5, .01, .005);
    scene.simulate.time = 3000;
    const results::SimulateResult result = simulate(scene);
    EXPECT_EQ(result.outcome, results::Outcome::offset) << result.evidence;
    EXPECT_GT(*result.residual_ratio, 1);
    for (const results::BalancerMotion &b : result.balancers)
        for (const double angle : b.angles)
            EXPECT_LT(std::abs(angle), 0.2); // the heavy side is at 0, less the lag by damping
}

struct Pendulums {
    double speed_ratio, external, hinge;
};

class TiedPendulums : public testing::TestWithParam<Pendulums> {};

// The only stable steady motion of the closed form is where the simulation ends.
TEST_P(TiedPendulums, EndInTheSteadyMotion) {
    const auto [ratio, external, hinge] = GetParam();
    constexpr double arm = 0.18;
    constexpr double imbalance = 0.02;
    const results::SimulateResult result =
        simulate(pendulum_rotor_scene(ratio, external, hinge, imbalance));
    auto rotor = closed_form::pendulum_rotor(5, 1, arm, 0.02);
    rotor.external_damping = external;
    rotor.hinge_damping = hinge;
    rotor.imbalance = imbalance / (2 * arm);
    std::vector<closed_form::PendulumMotion> stable;
    for (const auto &motion : closed_form::steady_motions(rotor, ratio))
        if (motion.stable)
            stable.push_back(motion);
    ASSERT_EQ(stable.size(), 1U);
    EXPECT_EQ(result.outcome, results::Outcome::offset); // pendulums leave 1 / (1 + rho)
    ASSERT_EQ(result.balancers.size(), 1U);
    const results::BalancerMotion &b = result.balancers.front();
    // By then what the start left has died out.
    EXPECT_NEAR(b.amplitude / arm, std::abs(stable.front().position),
                1e-5 * std::abs(stable.front().position));
    EXPECT_NEAR(b.angles.at(0), stable.front().phi, 1e-5);
    EXPECT_NEAR(b.angles.at(1), stable.front().psi, 1e-5);
}

INSTANTIATE_TEST_SUITE_P(Speeds, TiedPendulums,
                         testing::Values(Pendulums{0.5, 1, 0.5}, Pendulums{1.3, 1, 0.5},
                                         Pendulums{2.5, 1, 1}));

TEST(Simulate, MotorComesToItsIdleSpeed) {
    model::Case scene = rodrigues_rotor(4, .01, .005);
    scene.simulate.torque = 0.4;
    scene.simulate.torque_slope = 0.1;
    scene.simulate.inertia = 2;
    scene.speeds->from = 3.5;
    scene.simulate.time = 1500;
    const results::SimulateResult result = simulate(scene);
    // Balanced at last, the rotor turns without resistance but that of the motor.
    EXPECT_NEAR(result.speed, 4, 1e-3);
    EXPECT_EQ(result.outcome, results::Outcome::balanced) << result.evidence;
}

TEST(Simulate, SaysWhatIsMissing) {
    const auto message = [](const model::Case &scene) -> std::string {
        try {
            (void)simulate(scene);
        } catch (const model::BadInput &error) {
            return error.what();
        }
        return "no failure";
    };
    const auto contains = [](const std::string &text, const std::string &part) {
        return text.find(part) != std::string::npos;
    };
    model::Case scene = rodrigues_rotor(4, .01, .005);
    scene.speeds.reset();
    EXPECT_TRUE(contains(message(scene), "expected a spin speed"));
    scene = rodrigues_rotor(4, .01, .005);
    scene.speeds->count = 3;
    EXPECT_TRUE(contains(message(scene), "speeds.count"));
    scene = rodrigues_rotor(0, .01, .005);
    EXPECT_TRUE(contains(message(scene), "at rest"));
    scene = rodrigues_rotor(4, .01, .005);
    scene.simulate.time = 1e9;
    EXPECT_TRUE(contains(message(scene), "revolutions"));
    scene = rodrigues_rotor(4, .01, .005);
    scene.simulate.time = 0;
    EXPECT_TRUE(contains(message(scene), "[simulate]"));
}

TEST(Simulate, NotesWhatIsUnusual) {
    const auto noted = [](const model::Case &scene, const std::string &part) {
        const results::SimulateResult result = simulate(scene);
        return std::any_of(
            result.model.notes.begin(), result.model.notes.end(),
            [&](const std::string &note) { return note.find(part) != std::string::npos; });
    };
    model::Case scene = rodrigues_rotor(4, .01, .005);
    scene.simulate.time = 1;
    EXPECT_FALSE(noted(scene, "capacity"));
    scene.rotor.balancers[0].imbalance = 0.02; // two balls of 0.005 on radius 1
    EXPECT_TRUE(noted(scene, "capacity E = 0.5"));
    scene = rodrigues_rotor(4, .01, .005);
    scene.simulate.time = 1;
    scene.simulate.ball_angles.clear();
    tests::set_damping(scene.rotor.balancers[1], 0);
    for (model::Bearing &bearing : scene.rotor.bearings)
        bearing.rows.front().c.setZero();
    EXPECT_TRUE(noted(scene, "ball_angles is not given"));
    EXPECT_TRUE(noted(scene, "no damping: its balls"));
    EXPECT_TRUE(noted(scene, "no damping in the bearings"));
}

} // namespace
} // namespace whirl::analyses
