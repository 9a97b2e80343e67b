// Outcomes read from motions whose course is known in closed form, and from one whose growth is.

#include "simulation/outcome.h"

#include "support/balancer_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

namespace whirl::simulation {
namespace {

using Function = std::function<double(double)>;

constexpr double reference = 1e-4; ///< m, without balls

double still(double /*t*/) { return 0.3; }

/// A motion of one plane: its amplitude (m) and the angle of its first ball (rad) over time, and
/// growth that the eigenvalues promise.
results::SimulateResult outcome_of(double end, const Function &amplitude,
                                   const Function &angle = still,
                                   std::optional<double> linear = -1.0) {
    model::Case scene = tests::rodrigues_rotor(4, .01, .005);
    scene.rotor.balancers.resize(1);
    results::SimulateResult result;
    result.linear_growth = linear;
    result.balancers.resize(1);
    results::MotionSeries &series = result.series;
    series.amplitude.resize(1);
    series.angles.resize(2);
    double last = 0;
    for (int i = 0; i < 2000; ++i) {
        const double t = end * i / 1999;
        series.time.push_back(t);
        series.speed.push_back(4);
        series.amplitude[0].push_back(amplitude(t));
        series.angles[0].push_back(angle(t));
        series.angles[1].push_back(-still(t));
        if (t >= 0.975 * end)
            last = std::max(last, amplitude(t));
    }
    result.balancers[0].amplitude = last;
    result.balancers[0].reference = reference;
    classify(scene, result);
    return result;
}

std::string word(const results::SimulateResult &result) {
    return results::outcome_name(result.outcome);
}

TEST(MotionOutcome, growth_is_seen_however_small_the_motion_still_is) {
    for (const double start : {1e-9, 1e-7, 1e-5, 1e-3})
        for (const double end : {0.5, 2.0, 4.0}) {
            const auto amplitude = [&](double t) { return start * std::exp(2.2 * t); };
            const results::SimulateResult result = outcome_of(end, amplitude);
            EXPECT_EQ(word(result), "growing") << start << " m, " << end << " s";
            ASSERT_TRUE(result.trend);
            EXPECT_NEAR(*result.trend, 2.2, 2.2 * 1e-9); // a line through points of a line
        }
    // On top of a motion that stays: its swing grows.
    const auto hidden = [](double t) {
        return reference * (0.5 + 1e-4 * std::exp(0.5 * t) * std::sin(90 * t));
    };
    EXPECT_EQ(word(outcome_of(8, hidden)), "growing");
    // Balls that swing more and more.
    const auto balls = [](double t) { return 0.3 + 1e-3 * std::exp(0.4 * t) * std::sin(20 * t); };
    EXPECT_EQ(word(outcome_of(
                  8, [](double) { return reference / 100; }, balls)),
              "growing");
}

TEST(MotionOutcome, decay_to_balance) {
    const auto fast = [](double t) { return reference * std::exp(-3 * t); };
    EXPECT_EQ(word(outcome_of(20, fast)), "balanced");
    // Slow: where it stops at 0.37 of the amplitude without balls nobody knows how it ends; a
    // tenth, which counts as balanced, is there at ln(10) / 0.01.
    const auto slow = [](double t) { return reference * std::exp(-0.01 * t); };
    const results::SimulateResult undecided = outcome_of(100, slow);
    EXPECT_EQ(word(undecided), "undecided");
    ASSERT_TRUE(undecided.decision_time);
    // The amplitude is the largest over the last 2.5 s: off by that at most.
    EXPECT_NEAR(*undecided.decision_time, std::log(10) / 0.01, 3);
    EXPECT_EQ(word(outcome_of(std::log(10) / 0.01 + 10, slow)), "balanced");
}

TEST(MotionOutcome, what_stays_is_offset_or_whirling) {
    const auto settled = [](double t) { return reference * (0.5 + 0.5 * std::exp(-t / 5)); };
    EXPECT_EQ(word(outcome_of(100, settled)), "offset");
    const auto from_below = [](double t) { return reference * (1.2 - std::exp(-t / 5)); };
    EXPECT_EQ(word(outcome_of(100, from_below)), "offset");
    const auto creeps = [](double t) { return 0.3 + 0.005 * t; };
    EXPECT_EQ(word(outcome_of(
                  100, [](double) { return reference; }, creeps)),
              "undecided");
    for (const double beat : {0.7, 2.9, 40.0}) {
        const auto beating = [&](double t) { return reference * (0.5 + 0.2 * std::cos(beat * t)); };
        const auto swinging = [&](double t) { return 0.3 * std::sin(beat * t); };
        EXPECT_EQ(word(outcome_of(100, beating, swinging)), "whirling") << beat;
    }
    // A limit cycle that is reached.
    const auto cycle = [](double t) { return 0.4 * std::tanh(t / 10) * std::sin(5 * t); };
    EXPECT_EQ(word(outcome_of(
                  100, [](double) { return reference; }, cycle)),
              "whirling");
    // A swing of 0.2 rad that falls to 0.05 at ln(8) / 0.02.
    const auto dying = [](double t) { return 0.2 * std::exp(-0.02 * t) * std::sin(5 * t); };
    const results::SimulateResult undecided = outcome_of(
        50, [](double) { return reference / 100; }, dying);
    EXPECT_EQ(word(undecided), "undecided");
    ASSERT_TRUE(undecided.decision_time);
    EXPECT_NEAR(*undecided.decision_time, std::log(8) / 0.02, 5);
}

TEST(MotionOutcome, noise_of_the_integrator_is_no_trend) {
    std::mt19937 engine(3);
    for (int run = 0; run < 50; ++run) {
        double walk = 0; // errors of steps gather as a random walk
        const auto noise = [&](double) {
            walk += (static_cast<double>(engine()) / 4294967295.0 - 0.5) * 1e-8 * reference;
            return std::abs(walk);
        };
        EXPECT_EQ(word(outcome_of(20, noise)), "balanced");
    }
}

TEST(MotionOutcome, eigenvalues_overrule_a_balance_that_cannot_last) {
    const auto fast = [](double t) { return reference * std::exp(-3 * t); };
    const results::SimulateResult result = outcome_of(3, fast, still, 2.2);
    EXPECT_EQ(word(result), "undecided");
    ASSERT_TRUE(result.decision_time);
    // From the tolerance 1e-8 to its full size.
    EXPECT_NEAR(*result.decision_time, 3 + std::log(1e8) / 2.2, 1e-9);
    EXPECT_EQ(word(outcome_of(3, fast, still, std::nullopt)), "balanced");
    // Below the resonance the balanced position is unstable, and the offset lasts.
    EXPECT_EQ(word(outcome_of(
                  3, [](double) { return 2 * reference; }, still, 0.4)),
              "offset");
}

} // namespace
} // namespace whirl::simulation
