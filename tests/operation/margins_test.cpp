#include "operation/margins.h"

#include "analyses/critical.h"
#include "analyses/response.h"
#include "support/rigid_jeffcott.h"

#include <gtest/gtest.h>

namespace {

using namespace whirl;
using operation::margin_of;
using operation::required_margin;
using operation::separation_margins;
using results::MarginSide;
using results::SeparationMargin;
using results::Whirl;

constexpr auto unlimited = std::nullopt;

// By hand: 17 (1 - 1/(AF - 1.5)), and 10 more above; 16 and 26 from AF = 18.5 on.
TEST(RequiredMargin, ByHand) {
    const std::vector<std::array<double, 3>> table{
        {2.5, 0, 10}, {3.5, 8.5, 18.5}, {4, 10.2, 20.2}, {5.5, 12.75, 22.75},
        {10, 15, 25}, {18.5, 16, 26},   {100, 16, 26}};
    for (const auto &[factor, below, above] : table) {
        // Printed with all digits but for AF = 10: 17 (1 - 1/8.5) = 15.
        EXPECT_NEAR(required_margin(factor, MarginSide::below), below, 1e-13) << factor;
        EXPECT_NEAR(required_margin(factor, MarginSide::above), above, 1e-13) << factor;
    }
    EXPECT_EQ(required_margin(2.4999, MarginSide::below), 0);
    EXPECT_EQ(required_margin(2.4999, MarginSide::above), 0);
    EXPECT_EQ(required_margin(unlimited, MarginSide::below), 16);
    EXPECT_EQ(required_margin(unlimited, MarginSide::above), 26);
}

TEST(Margin, IsAShareOfTheNearerEnd) {
    const model::Operation at{1000, 2000, {}};
    const SeparationMargin below = margin_of(900, 3.5, at); // 10 % against 8.5 %
    EXPECT_EQ(below.side, MarginSide::below);
    EXPECT_DOUBLE_EQ(below.found, 10);
    EXPECT_TRUE(below.passes);
    EXPECT_FALSE(margin_of(900, 4, at).passes);              // 10.2 % required
    const SeparationMargin above = margin_of(2400, 3.5, at); // 20 % against 18.5 %
    EXPECT_EQ(above.side, MarginSide::above);
    EXPECT_DOUBLE_EQ(above.found, 20);
    EXPECT_TRUE(above.passes);
    EXPECT_FALSE(margin_of(2400, 4, at).passes); // 20.2 %
}

TEST(Margin, NeverPassesInsideTheRangeOrBelowTheTripSpeed) {
    const model::Operation at{1000, 2000, 2900};
    for (const double speed : {1000.0, 1500.0, 2000.0}) {
        const SeparationMargin inside = margin_of(speed, 2.5, at);
        EXPECT_EQ(inside.side, MarginSide::inside);
        EXPECT_FALSE(inside.required.has_value());
        EXPECT_FALSE(inside.passes);
        EXPECT_TRUE(margin_of(speed, 2.4, at).passes); // critically damped
    }
    EXPECT_FALSE(margin_of(2800, 3.5, at).passes); // 40 % are more than 18.5 %
    EXPECT_TRUE(margin_of(2950, 3.5, at).passes);
    EXPECT_TRUE(margin_of(2800, 2.4, at).passes);
}

results::CriticalSpeed critical(double speed, Whirl whirl, double factor) {
    results::CriticalSpeed out;
    out.speed = speed;
    out.whirl = whirl;
    out.damping.amplification = factor;
    return out;
}

results::ResponsePeak peak(const char *of, double z, double speed, double value, double factor) {
    results::ResponsePeak out;
    out.of = of;
    out.z = z;
    out.speed = speed;
    out.value = value;
    out.amplification = factor;
    return out;
}

const model::Operation running{1000, 2000, {}};

std::vector<SeparationMargin> margins_of(const std::vector<results::CriticalSpeed> &speeds,
                                         const std::vector<results::ResponsePeak> &peaks,
                                         bool backward_too) {
    std::vector<results::Sentence> notes;
    return separation_margins(running, speeds, peaks, backward_too, notes);
}

TEST(Margins, TakeTheLargestPeakOfACriticalSpeedElseItsDamping) {
    const std::vector<results::CriticalSpeed> speeds{critical(500, Whirl::forward, 10),
                                                     critical(3000, Whirl::forward, 8)};
    const std::vector<results::ResponsePeak> peaks{peak("station", 0, 505, 1e-6, 9),
                                                   peak("station", 1, 510, 3e-6, 11),
                                                   peak("bearing", 0, 507, 900, 12)};
    const auto margins = margins_of(speeds, peaks, false);
    ASSERT_EQ(margins.size(), 2U);
    EXPECT_EQ(margins[0].source, "response");
    EXPECT_EQ(margins[0].speed, 510);
    EXPECT_EQ(margins[0].amplification, 11);
    EXPECT_EQ(margins[0].z, 1);
    EXPECT_EQ(margins[0].whirl, Whirl::forward);
    EXPECT_EQ(margins[1].source, "damping");
    EXPECT_EQ(margins[1].speed, 3000);
    EXPECT_EQ(margins[1].amplification, 8);
}

TEST(Margins, AreThoseOfProbesWhereThereAreAny) {
    const auto margins =
        margins_of({critical(500, Whirl::forward, 10)},
                   {peak("station", 0, 505, 5e-6, 9), peak("probe", 1, 510, 3e-6, 11)}, false);
    ASSERT_EQ(margins.size(), 1U);
    EXPECT_EQ(margins[0].of, "probe");
    EXPECT_EQ(margins[0].amplification, 11);
}

// The factor differs from probe to probe, and with it what is required; a probe that reads less may
// be the one that fails.
TEST(Margins, AreThoseOfEveryProbeTheLargestReadingFirst) {
    std::vector<results::ResponsePeak> peaks{
        peak("probe", 0.1, 905, 1e-6, 4), peak("probe", 0.9, 900, 3e-6, 3.5),
        peak("probe", 0.9, 899, 2e-6, 3.6), peak("probe", 0.5, 902, 2e-6, 2.4),
        peak("probe", 0.5, 400, 2e-7, 20)};
    for (std::size_t i = 0; i < peaks.size(); ++i) // two at z = 0.9 that look different ways
        peaks[i].place = std::min<int>(static_cast<int>(i), 3);
    const auto margins = margins_of(
        {critical(400, Whirl::forward, 20), critical(900, Whirl::forward, 4)}, peaks, false);
    ASSERT_EQ(margins.size(), 4U); // without the factor of 2.4
    EXPECT_EQ(margins[0].speed, 400);
    EXPECT_EQ(margins[1].speed, 900); // 10 % found, 17 (1 - 1/2) = 8.5 % required
    EXPECT_TRUE(margins[1].passes);
    EXPECT_EQ(margins[2].speed, 899); // 10.1 %, 17 (1 - 1/2.1) = 8.9 %
    EXPECT_TRUE(margins[2].passes);
    EXPECT_EQ(margins[3].z, 0.1); // 9.5 %, 17 (1 - 1/2.5) = 10.2 %
    EXPECT_FALSE(margins[3].passes);
    // A peak that does not come down to its half-power points is not passed over in silence.
    peaks[0].amplification.reset();
    std::vector<results::Sentence> notes;
    (void)separation_margins(running, {critical(900, Whirl::forward, 4)}, peaks, false, notes);
    ASSERT_EQ(notes.size(), 1U);
    EXPECT_NE(notes[0].find("the peak of probe at z = 0.1 m, 905 rad/s"), std::string::npos);
}

// Rotors and bearings both anisotropic have no critical speeds: what is of one resonance is seen by
// its peaks alone.
TEST(Margins, WithoutCriticalSpeedsPeaksOfOneResonanceAreOne) {
    std::vector<results::ResponsePeak> peaks{
        peak("station", 0.0, 500, 5e-6, 8),  peak("station", 0.5, 504, 3e-6, 7),
        peak("station", 1.0, 520, 4e-6, 9),  peak("station", 0.0, 560, 6e-6, 10),
        peak("station", 0.5, 562, 7e-6, 10), peak("station", 1.0, 2900, 1e-6, 12)};
    const std::vector<int> places{0, 1, 2, 0, 1, 2};
    for (std::size_t i = 0; i < peaks.size(); ++i)
        peaks[i].place = places[i];
    const auto of_stations = margins_of({}, peaks, true);
    ASSERT_EQ(of_stations.size(), 3U); // two at z = 0 within each other's width are two
    EXPECT_EQ(of_stations[0].speed, 500);
    EXPECT_EQ(of_stations[1].speed, 562);
    EXPECT_EQ(of_stations[2].speed, 2900);
    for (auto &each : peaks)
        each.of = "probe";
    const auto of_probes = margins_of({}, peaks, true);
    ASSERT_EQ(of_probes.size(), 6U); // each must have its margin, the one that reads most first
    EXPECT_EQ(of_probes[0].speed, 500);
    EXPECT_EQ(of_probes[1].speed, 520);
    EXPECT_EQ(of_probes[2].speed, 504);
    EXPECT_EQ(of_probes[3].speed, 562);
}

TEST(Margins, LeaveOutHeavilyDampedOnesAndBackwardWhirlThatNothingExcites) {
    const std::vector<results::CriticalSpeed> speeds{critical(300, Whirl::backward, 10),
                                                     critical(500, Whirl::forward, 2.4),
                                                     critical(700, Whirl::forward, 2.5)};
    for (const bool backward_too : {false, true}) {
        const auto margins = margins_of(speeds, {}, backward_too);
        ASSERT_EQ(margins.size(), 1U);
        EXPECT_EQ(margins[0].speed, 700);
    }
    // With a peak of its own it is excited; on equal bearings it cannot be.
    const std::vector<results::ResponsePeak> peaks{peak("station", 0, 301, 1e-6, 9)};
    EXPECT_EQ(margins_of(speeds, peaks, true).front().whirl, Whirl::backward);
    EXPECT_FALSE(margins_of(speeds, peaks, false).front().whirl.has_value());
}

/// A critical speed that its damping would count has no margin only with a word why.
TEST(Margins, SayWhyACriticalSpeedIsNotAmongThem) {
    const auto notes_of = [](const std::vector<results::CriticalSpeed> &speeds,
                             const std::vector<results::ResponsePeak> &peaks, bool backward_too) {
        std::vector<results::Sentence> notes;
        (void)separation_margins(running, speeds, peaks, backward_too, notes);
        return notes;
    };
    const std::vector<results::CriticalSpeed> speeds{
        critical(300, Whirl::backward, 10), critical(500, Whirl::forward, 2.4),
        critical(700, Whirl::forward, 2.7), critical(2600, Whirl::backward, 9)};
    const auto without = notes_of(speeds, {}, true); // 2600 is 30 % above the range: any AF does
    ASSERT_EQ(without.size(), 1U);
    EXPECT_NE(without[0].find("backward critical speed 300 rad/s"), std::string::npos);
    EXPECT_NE(without[0].find("no peak of its own"), std::string::npos);
    EXPECT_TRUE(notes_of(speeds, {}, false).empty()); // nothing excites it on equal bearings
    const auto damped =
        notes_of(speeds, {peak("probe", 0, 301, 1e-6, 9), peak("probe", 0, 710, 1e-6, 2.3)}, true);
    ASSERT_EQ(damped.size(), 1U);
    EXPECT_NE(damped[0].find("forward critical speed 700 rad/s"), std::string::npos);
    EXPECT_NE(damped[0].find("has an amplification factor of 2.3, below 2.5"), std::string::npos);
}

/// Where a free motion grows the peak of the steady motion is no measure: the margin fails, and
/// what is said of it is said once.
TEST(Margins, OfAMotionThatGrowsFail) {
    std::vector<results::CriticalSpeed> speeds{critical(400, Whirl::backward, 1),
                                               critical(500, Whirl::forward, 1)};
    for (results::CriticalSpeed &one : speeds) {
        one.damping.amplification.reset();
        one.damping.ratio = -0.03;
    }
    std::vector<results::Sentence> notes;
    const auto margins =
        separation_margins(running, speeds, {peak("station", 0, 501, 1e-6, 17)}, false, notes);
    ASSERT_EQ(margins.size(), 1U);
    EXPECT_EQ(margins[0].speed, 501);
    EXPECT_GT(margins[0].found, *margins[0].required);
    EXPECT_TRUE(margins[0].grows);
    EXPECT_FALSE(margins[0].passes);
    ASSERT_EQ(notes.size(), 2U);
    EXPECT_NE(notes[0].find("backward mode is unstable"), std::string::npos);
    EXPECT_NE(notes[0].find("no margin"), std::string::npos);
    EXPECT_NE(notes[1].find("forward mode is unstable"), std::string::npos);
    EXPECT_NE(notes[1].find("fails whatever its margin"), std::string::npos);
}

/// The damping ratio -Re/|lambda| of m l^2 + c l + k is zeta: AF = 1/(2 zeta).
TEST(Margins, JeffcottRotorByDamping) {
    tests::RigidJeffcott rotor;
    model::Case scene = rotor.scene();
    scene.operation = model::Operation{400, 600, 660};
    const auto result = analyses::critical_speeds(scene);
    ASSERT_TRUE(result.margins.has_value());
    ASSERT_EQ(result.margins->size(), 1U); // a thin disc tilts at no forward critical speed
    const SeparationMargin &margin = result.margins->front();
    const double speed = rotor.natural() * std::sqrt(1 - 0.01);
    // Rounding of an eigenvalue problem of two unknowns.
    EXPECT_NEAR(*margin.amplification, 5, 1e-10);
    EXPECT_NEAR(margin.speed, speed, 1e-10 * speed);
    EXPECT_NEAR(margin.found, 100 * (400 - speed) / 400, 1e-9);
    EXPECT_NEAR(*margin.required, 17 * (1 - 1 / 3.5), 1e-9);
    EXPECT_TRUE(margin.passes);
    EXPECT_EQ(margin.source, "damping");
}

/// |w| = e W^2/|w_n^2 - W^2 + 2 i zeta w_n W| has its peak at w_n/sqrt(1 - 2 zeta^2), and falls to
/// 1/sqrt(2) of it where (8 zeta^2 (1 - zeta^2) - 1) s^2 + (2 - 4 zeta^2) s - 1 = 0, s = (W/w_n)^2.
TEST(Margins, JeffcottRotorByHalfPowerPoints) {
    tests::RigidJeffcott rotor;
    model::Case scene = rotor.scene();
    scene.rotor.imbalances = {tests::imbalance_at(0.5, 1e-4)};
    scene.speeds = model::SpeedRange{50, 700, 14};
    scene.operation = model::Operation{400, 600, {}};
    const double square = rotor.ratio() * rotor.ratio();
    const double a = 8 * square * (1 - square) - 1;
    const double b = 2 - 4 * square;
    const double low = (-b + std::sqrt(b * b + 4 * a)) / (2 * a);
    const double high = (-b - std::sqrt(b * b + 4 * a)) / (2 * a);
    const double top = 1 / std::sqrt(1 - 2 * square);
    const double factor = top / (std::sqrt(high) - std::sqrt(low));
    const auto response = analyses::unbalance_response(scene).margins;
    const auto by_critical = analyses::critical_speeds(scene).margins;
    for (const auto &margins : {response, by_critical}) {
        ASSERT_TRUE(margins.has_value());
        ASSERT_EQ(margins->size(), 1U);
        const SeparationMargin &margin = margins->front();
        EXPECT_EQ(margin.source, "response");
        EXPECT_TRUE(margin.whirl.has_value()); // it belongs to the critical speed
        // Peaks are found to 1e-9, half-power points likewise.
        EXPECT_NEAR(margin.speed / (top * rotor.natural()), 1, 1e-8);
        EXPECT_NEAR(*margin.amplification / factor, 1, 1e-7);
    }
}

TEST(Margins, AHeavilyDampedCriticalSpeedStaysInTheListOfCriticalSpeeds) {
    tests::RigidJeffcott rotor;
    rotor.c *= 2.5; // zeta 0.25, AF 2
    model::Case scene = rotor.scene();
    scene.operation = model::Operation{200, 600, {}};
    const auto result = analyses::critical_speeds(scene);
    EXPECT_TRUE(result.margins->empty());
    EXPECT_TRUE(std::any_of(result.critical_speeds.begin(), result.critical_speeds.end(),
                            [](const auto &c) { return c.damping.heavy(); }));
    scene.operation.reset();
    EXPECT_FALSE(analyses::critical_speeds(scene).margins.has_value());
}

} // namespace
