// Sweeps in time and many starts, against steady states and steady responses, which no motion in
// time enters, and published intervals.

#include "analyses/balance.h"
#include "analyses/many_starts.h"
#include "analyses/simulate.h"
#include "input/case_file.h"
#include "model/errors.h"
#include "support/rigid_jeffcott.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace whirl::analyses {
namespace {

using results::HeldMotion;
using std::numbers::pi;

model::Case two_balls(const std::vector<std::string> &settings) {
    return input::load_case(WHIRL_ROOT "/cases/sweep_two_balls", settings);
}

/// Holds each speed, up and down again.
void sweep(model::Case &scene, const std::vector<double> &speeds, double hold, double ramp) {
    std::vector<double> all = speeds;
    all.insert(all.end(), speeds.rbegin() + 1, speeds.rend());
    model::SimulateSettings &s = scene.simulate;
    s.run_up = {{0, speeds.front()}};
    s.time = 0;
    s.held.clear();
    for (std::size_t k = 0; k < all.size(); ++k) {
        const double reached = s.time + ramp;
        s.time = reached + hold;
        s.held.push_back({k < speeds.size(), all[k], reached, s.time});
        s.run_up.insert(s.run_up.end(), {{reached, all[k]}, {s.time, all[k]}});
    }
    s.output_points = static_cast<int>(150 * all.size());
}

// Without balls the motion at each speed is the forced response U W^2/(k - M W^2 + i c W), and the
// way does not matter. What the ramps leave dies out at c/(2 M) = 32 1/s: 3e-9 of it in the first
// two thirds of 0.9 s.
TEST(Sweep, OfALinearRotorIsItsForcedResponse) {
    tests::RigidJeffcott rotor;
    model::Case scene = rotor.scene();
    constexpr double imbalance = 0.004;
    scene.rotor.imbalances = {tests::imbalance_at(0.5, imbalance)};
    sweep(scene, {200, 300, 320, 600}, 0.9, 0.1);
    const results::SimulateResult result = simulate(scene);
    ASSERT_TRUE(result.sweep);
    ASSERT_EQ(result.sweep->motions.size(), 7U);
    EXPECT_TRUE(result.sweep->jumps.empty());
    EXPECT_TRUE(result.sweep->hysteresis.empty());
    EXPECT_FALSE(result.sweep->states);
    for (const HeldMotion &motion : result.sweep->motions) {
        const double W = motion.speed;
        const double forced = imbalance * W * W /
                              std::abs(std::complex<double>(1e6 - rotor.mass * W * W, rotor.c * W));
        EXPECT_TRUE(motion.settled) << W;
        ASSERT_EQ(motion.amplitude.size(), result.stations.size());
        // Integrator, 1e-8 a step, and the largest |w| of samples of a circle.
        EXPECT_NEAR(motion.largest(), forced, 1e-6 * forced) << W;
        EXPECT_NEAR(motion.rms[1], forced, 1e-6 * forced) << W;
    }
}

// The certified steady states at the same speeds: where the balls came to rest, amplitude and
// angles are those of the state; going up they leave the coincident one at its fold, 250.998 rad/s,
// and going down balance where small motions about it begin to grow, 425.050 rad/s.
class SweepOfTwoBalls : public testing::Test {
  protected:
    static const results::HeldSweep &swept() {
        static const results::SimulateResult result = simulate(two_balls({}));
        return result.sweep.value();
    }
};

TEST_F(SweepOfTwoBalls, RestsInSteadyStates) {
    int at_rest = 0;
    for (const HeldMotion &motion : swept().motions) {
        if (!motion.settled || !motion.at_rest)
            continue;
        ASSERT_TRUE(motion.state) << motion.speed;
        const results::SteadyState &state = swept().states->states[*motion.state];
        EXPECT_TRUE(*state.stable || motion.speed == 425) << motion.speed; // growth 0.007 1/s
        EXPECT_NEAR(motion.largest(), state.residual,
                    state.residual > 1e-12 ? 1e-6 * state.residual : 1e-5)
            << motion.speed;
        ++at_rest;
    }
    EXPECT_GT(at_rest, 20);
}

TEST_F(SweepOfTwoBalls, JumpsWhereStatesEnd) {
    const std::vector<results::MotionJump> &jumps = swept().jumps;
    const auto fold = std::ranges::find_if(swept().states->borders, [](const auto &border) {
        return border.kind == results::SteadyBorder::Kind::fold;
    });
    ASSERT_NE(fold, swept().states->borders.end());
    EXPECT_LT(jumps.front().from, fold->speed);
    EXPECT_GT(jumps.front().to, fold->speed);
    const auto down = std::ranges::find_if(jumps, [](const auto &jump) { return !jump.up; });
    ASSERT_NE(down, jumps.end());
    const auto hopf = std::ranges::find_if(swept().states->borders, [&](const auto &border) {
        return border.kind == results::SteadyBorder::Kind::pair && border.growing_below > 0 &&
               border.growing_above == 0;
    });
    ASSERT_NE(hopf, swept().states->borders.end());
    EXPECT_NEAR(down->from, hopf->speed, 25); // a step of the sweep
    EXPECT_LT(down->to, hopf->speed);
}

TEST_F(SweepOfTwoBalls, DependsOnTheWayWhereBalanceIsNotReachedGoingUp) {
    ASSERT_EQ(swept().hysteresis.size(), 1U);
    const auto [from, to] = swept().hysteresis.front();
    const auto up = std::ranges::find_if(
        swept().jumps, [](const auto &jump) { return jump.up && jump.after < 0.01 * jump.before; });
    ASSERT_NE(up, swept().jumps.end());
    EXPECT_EQ(to, up->from);
    for (const HeldMotion &motion : swept().motions)
        if (motion.speed >= from && motion.speed <= to)
            EXPECT_EQ(motion.at_rest, !motion.up) << motion.speed;
}

// The motions that balance asks for are as long as the motion before the sweep, and at one speed.
TEST(Sweep, IsNoPartOfTheMotionsInBalance) {
    const auto simulated = [](std::vector<std::string> settings) {
        for (const char *setting : {"speeds.to=600", "speeds.count=3", "balance.simulated=1",
                                    "balance.balanced_position=false"})
            settings.emplace_back(setting);
        return balance(two_balls(settings)).simulated;
    };
    const auto with = simulated({"simulate.starts.count=2"});
    const auto without = simulated({"simulate.sweep="});
    ASSERT_EQ(with.size(), 1U);
    ASSERT_EQ(without.size(), 1U);
    // More points of the time series, at which the integrator stops: nothing else. After the time
    // of the sweep rounding would be left.
    const double left = without.front().residual_ratio.value();
    EXPECT_GT(left, 1e-6);
    EXPECT_NEAR(with.front().residual_ratio.value(), left, 0.01 * left);
}

model::Case starts(const std::vector<std::string> &more) {
    std::vector<std::string> settings{"simulate.sweep=", "speeds.from=500", "simulate.time=4"};
    settings.insert(settings.end(), more.begin(), more.end());
    return two_balls(settings);
}

// Sample i follows from the seed and i alone.
TEST(Starts, AreTheSameForOneSeed) {
    const auto of = [](const char *count, const char *seed) {
        return simulate(starts({count, seed})).starts.value();
    };
    const auto five = of("simulate.starts.count=5", "simulate.starts.seed=3");
    const auto three = of("simulate.starts.count=3", "simulate.starts.seed=3");
    const auto other = of("simulate.starts.count=3", "simulate.starts.seed=4");
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(five.motions[i].start_angles, three.motions[i].start_angles);
        EXPECT_EQ(five.motions[i].motion->angles, three.motions[i].motion->angles);
        EXPECT_NE(other.motions[i].start_angles, three.motions[i].start_angles);
    }
    int sum = 0;
    double shares = 0;
    for (const results::MotionEnd &end : five.ends) {
        sum += end.count;
        shares += end.share;
    }
    EXPECT_EQ(sum + five.left_out, 5);
    EXPECT_NEAR(shares, 1, 1e-15);
}

// Two equal balls in races of their own can be told apart: balance has each on either side of the
// imbalance. Exchanging the starts exchanges the ends, so that both are equally probable.
TEST(Starts, OfTwoMirroredStatesAreEquallyProbable) {
    const model::Case scene = [] {
        model::Case out = starts({"simulate.starts.count=60"});
        auto &rows = std::get<model::Balls>(out.rotor.balancers.front().parts).rows;
        rows.front().n = 1;
        rows.push_back(rows.front());
        return out;
    }();
    const auto of = simulate(scene).starts.value();
    int first_on_the_left = 0;
    for (const results::StartedMotion &start : of.motions) {
        ASSERT_TRUE(start.motion && start.motion->at_rest);
        const std::vector<double> &angles = start.motion->angles.front();
        EXPECT_NEAR(std::abs(angles[0]), std::acos(-0.4), 1e-4); // U/(2 m R) = 0.4
        EXPECT_NEAR(angles[0], -angles[1], 1e-4);
        first_on_the_left += angles[0] > 0 ? 1 : 0;
    }
    const results::Interval interval = probability_interval(first_on_the_left, 60);
    EXPECT_LT(interval.from, 0.5);
    EXPECT_GT(interval.to, 0.5);
}

// A grid over two equal balls is symmetric about its diagonal.
TEST(Starts, OfAGridAreSymmetricForEqualBalls) {
    constexpr std::size_t n = 6;
    const auto of = simulate(starts({"speeds.from=600", "simulate.starts.kind=grid",
                                     "simulate.starts.count=6"}))
                        .starts.value();
    ASSERT_EQ(of.motions.size(), n * n);
    EXPECT_NEAR(of.grid.front(), -pi + pi / n, 1e-15);
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t k = 0; k < n; ++k) {
            const std::vector<double> &start = of.motions[i + n * k].start_angles;
            EXPECT_EQ(start[0], of.grid[i]);
            EXPECT_NEAR(start[1], of.grid[k], 1.1e-6); // equal balls are set apart by 1e-6
            ASSERT_TRUE(of.motions[i + n * k].end);
            EXPECT_EQ(*of.motions[i + n * k].end, *of.motions[k + n * i].end) << i << " " << k;
        }
    for (const results::MotionEnd &end : of.ends)
        EXPECT_FALSE(end.low);
}

TEST(Starts, MustEndAtAConstantSpeed) {
    EXPECT_THROW(
        (void)simulate(starts({"simulate.starts.count=2", "simulate.run_up=[[0, 400], [4, 500]]"})),
        model::BadInput);
}

// R. G. Newcombe, Two-sided confidence intervals for the single proportion, Statistics in Medicine
// 17 (1998) 857-872, Table I, method 5 (Clopper and Pearson), to four digits.
TEST(ProbabilityInterval, IsAsPublished) {
    struct Published {
        int count, of;
        double from, to;
    };
    for (const auto &[count, of, from, to] :
         {Published{81, 263, 0.2527, 0.3676}, Published{15, 148, 0.0578, 0.1617},
          Published{0, 20, 0.0000, 0.1684}, Published{1, 29, 0.0009, 0.1776}}) {
        const results::Interval interval = probability_interval(count, of);
        EXPECT_NEAR(interval.from, from, 5e-5) << count;
        EXPECT_NEAR(interval.to, to, 5e-5) << count;
    }
    // None or all of n: 1 - p^n = 0.975.
    EXPECT_NEAR(probability_interval(0, 7).to, 1 - std::pow(0.025, 1.0 / 7), 1e-14);
    EXPECT_NEAR(probability_interval(7, 7).from, std::pow(0.025, 1.0 / 7), 1e-14);
}

} // namespace
} // namespace whirl::analyses
