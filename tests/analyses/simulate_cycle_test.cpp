// The limit cycle that simulate names, against the motion in time itself.

#include "analyses/simulate.h"
#include "results/simulate.h"
#include "support/balancer_scenes.h"
#include "support/rigid_jeffcott.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace whirl::tests {
namespace {

/// Two balls beside each other on a planar rotor that stall next to its critical speed, 316 rad/s.
model::Case stalled_balls() {
    model::Case scene = RigidJeffcott{}.scene();
    scene.name = "stalled balls";
    scene.rotor.balancers = {ball_balancer(0.5, 2, 0.05, 0.1, 0.5, 0)};
    scene.rotor.imbalances = {imbalance_at(0.5, 0.002, 0)};
    scene.speeds = model::SpeedRange{400, 400, 1};
    scene.simulate.time = 6;
    scene.simulate.ball_angles = {{0, 0.3}};
    scene.simulate.tolerance = 1e-10;
    scene.simulate.cycle.emplace();
    return scene;
}

TEST(SimulateCycle, IsWhatTheMotionSettlesTo) {
    const results::SimulateResult result = analyses::simulate(stalled_balls(), nullptr);
    ASSERT_EQ(result.outcome, results::Outcome::lagging) << result.evidence.text();
    ASSERT_TRUE(result.cycle);
    const results::LimitCycle &cycle = result.cycle->cycle;
    EXPECT_EQ(cycle.stable, true);
    // Started side by side the balls come together by exp(-h t/2), h = 10 1/s; the rest dies out
    // faster. After 6 s 1e-13 is left.
    EXPECT_LT(result.cycle->away, 1e-5);
    EXPECT_NEAR(cycle.growth, -5, 1e-4);
    const std::vector<double> &amplitude = result.series.amplitude.front();
    const auto last = amplitude.end() - static_cast<std::ptrdiff_t>(amplitude.size() / 10);
    // An extreme between instants of the cycle is missed by (pi/720)^2/2 of the swing.
    EXPECT_NEAR(cycle.largest.front(), *std::max_element(last, amplitude.end()),
                1e-5 * cycle.largest.front());
}

TEST(SimulateCycle, SaysWhyThereIsNone) {
    model::Case scene = stalled_balls();
    scene.simulate.gravity = 9.81;
    const results::SimulateResult result = analyses::simulate(scene, nullptr);
    EXPECT_FALSE(result.cycle);
    EXPECT_TRUE(std::ranges::any_of(result.model.notes, [](const results::Sentence &note) {
        return note.text().starts_with("no limit cycle: weight");
    }));
}

} // namespace
} // namespace whirl::tests
