// Rings that hang on a journal of the rotor: their linear element against their motion in time, and
// what they balance.

#include "balancers/small_motions.h"

#include "analyses/simulate.h"
#include "analyses/stability.h"
#include "support/ring_scenes.h"

#include <numbers>

namespace whirl {
namespace {

using std::numbers::pi;
using tests::expect_same_motions;
using tests::tilting;

// The derivatives of the motion are good to 1e-13 of its largest rates (rotating_rates.h), which
// leaves 3e-12 of the eigenvalues. Those beyond 1000 1/s stand in for zeros.
TEST(Rings, SmallMotionsAreThoseOfTheLinearElement) {
    for (const double speed : {30.0, 90.0, 150.0, 400.0})
        for (const int n : {2, 3, 4})
            for (const double E : {1.3, 2.0, 3.7})
                expect_same_motions(tilting(tests::ring_balancer(0, n, n * 0.1 * 0.01 / E), speed),
                                    1e-10, 1000);
}

TEST(Rings, SmallMotionsWithAPointMassAndAPhase) {
    model::Balancer rings = tests::ring_balancer(0, 3, 1.2e-3);
    rings.imbalance_radius = 0.08;
    rings.imbalance_phase = 0.7;
    for (const double speed : {40.0, 170.0})
        expect_same_motions(tilting(rings, speed), 1e-10, 1000);
}

TEST(Rings, BalanceAboveTheCriticalSpeedAndNotBelow) {
    for (const double speed : {140.0, 200.0, 300.0}) {
        const results::SimulateResult result = analyses::simulate(tests::ring_rotor(speed));
        EXPECT_EQ(result.outcome, results::Outcome::balanced) << speed << result.evidence;
        // cos a = -1/E of each of the two rings
        for (const std::size_t j : {0U, 1U})
            EXPECT_NEAR(std::abs(result.balancers[0].angles[j]), 2 * pi / 3, 1e-6) << speed;
        EXPECT_LT(result.residual_ratio.value(), 1e-6);
    }
    for (const double speed : {50.0, 80.0}) {
        const results::SimulateResult result = analyses::simulate(tests::ring_rotor(speed));
        EXPECT_NE(result.outcome, results::Outcome::balanced) << speed;
        EXPECT_GT(result.residual_ratio.value(), 1) << speed;
    }
}

/// The speed from which the balanced position is stable, with rings, imbalance and resistances
/// `share` times as large.
double stable_from(double share) {
    model::Case scene = tests::ring_rotor(0);
    auto &rings = std::get<model::Rings>(scene.rotor.balancers[0].parts);
    for (double *size : {&rings.mass, &rings.inertia, &rings.damping, &rings.drag})
        *size *= share;
    scene.rotor.balancers[0].imbalance *= share;
    scene.speeds = model::SpeedRange{90, 150, 13};
    const auto same = [&](const auto & /*overrides*/) { return scene; };
    return analyses::stability(scene, same).unstable.at(0).to;
}

// The equations of motion of all rings, from the Lagrangian by computer algebra and linearised
// numerically, to 1e-11.
TEST(Rings, AreStableFromTheSpeedOfTheirLagrangian) {
    EXPECT_NEAR(stable_from(1), 128.2258884165, 1e-8);
}

// The criterion is that of balancers without mass: stable from the critical speed, 100 rad/s. The
// difference falls as the mass, by ten a decade to a hundredth.
TEST(Rings, ApproachTheCriterionAsTheirMassGoesToZero) {
    const double thousandth = stable_from(1e-3) - 100;
    const double less = stable_from(1e-4) - 100;
    EXPECT_GT(less, 0);
    EXPECT_LT(less, 0.1);
    EXPECT_NEAR(std::log10(thousandth / less), 1, 0.01);
}

} // namespace
} // namespace whirl
