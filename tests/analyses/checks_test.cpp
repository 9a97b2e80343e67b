// The verdict on a machine: what passes by hand calculation passes, and nothing passes that was not
// judged.

#include "analyses/checks/checks.h"

#include "analyses/critical.h"
#include "analyses/response.h"
#include "analyses/stability.h"
#include "model/errors.h"
#include "operation/level1_verdict.h"
#include "support/balancer_parts.h"
#include "support/two_mass_machine.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace checks_test {
namespace {

using namespace whirl;
using results::Assessment;
using results::Check;
using results::Judgement;
using tests::TwoMassMachine;

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// All that was computed of a case, for its checks; what cannot be is missing.
struct Analysed {
    explicit Analysed(const model::Case &of) : scene(of) {
        take(response, computed.no_response, [&] { return analyses::unbalance_response(scene); });
        take(critical, computed.no_critical,
             [&] { return analyses::critical_speeds(scene, false); });
        take(stability, computed.no_stability,
             [&] { return analyses::stability(analyses::over_operation(scene), {}); });
        computed.response = response ? &*response : nullptr;
        computed.critical = critical ? &*critical : nullptr;
        computed.stability = stability ? &*stability : nullptr;
    }
    model::Case scene;
    std::optional<results::ResponseResult> response;
    std::optional<results::CriticalResult> critical;
    std::optional<results::StabilityResult> stability;
    analyses::Computed computed;

    [[nodiscard]] Assessment assess() const { return analyses::assess(scene, computed); }

  private:
    template <class Result, class Make>
    static void take(std::optional<Result> &result, results::Sentence &why, const Make &make) {
        try {
            result = make();
        } catch (const model::Failure &failure) {
            why = failure.sentence();
        }
    }
};

Assessment assess(const model::Case &scene) { return Analysed(scene).assess(); }

std::vector<Check> named(const Assessment &all, const std::string &name) {
    std::vector<Check> out;
    std::ranges::copy_if(all.checks, std::back_inserter(out),
                         [&name](const Check &check) { return check.name == name; });
    return out;
}

/// None of that name passes, and there is one.
void expect_no_pass(const Assessment &all, const std::string &name) {
    const std::vector<Check> found = named(all, name);
    EXPECT_FALSE(found.empty()) << name;
    for (const Check &check : found) {
        EXPECT_FALSE(check.pass.value_or(false)) << name << ", " << check.where;
        EXPECT_EQ(check.pass.has_value(), check.why.empty()) << name << ": " << check.why;
    }
    EXPECT_NE(all.verdict, Judgement::passes) << name;
    EXPECT_FALSE(all.sentence.empty());
}

/// Every check of that name waits to be judged.
void expect_not_judged(const Assessment &all, const std::string &name) {
    expect_no_pass(all, name);
    for (const Check &check : named(all, name))
        EXPECT_FALSE(check.pass.has_value()) << name << ", " << check.where;
}

const std::string shaft = "vibration of the shaft";
const std::string pedestal = "vibration of a pedestal";
const std::string clearance = "share of the clearance";
const std::string margin = "separation margin";
const std::string factor = "amplification factor of a critical speed at operating speeds";
const std::string growth = "growth of free motions";

/// A machine between its resonances, near 283 and 870 rad/s, that passes everything.
model::Case sound() {
    model::Case scene = TwoMassMachine().scene();
    scene.operation = model::Operation{480, 560, 580};
    scene.limits.emplace();
    scene.limits->shaft = 60e-6;
    scene.limits->velocity = 10e-3;
    scene.limits->clearance = 0.75;
    scene.limits->scale_most = 1.2;
    return scene;
}

TEST(Checks, OfAMachineThatPasses) {
    const model::Case scene = sound();
    const Assessment all = assess(scene);
    for (const Check &check : all.checks)
        EXPECT_TRUE(check.pass.value_or(false))
            << check.name << ", " << check.where << ": " << check.value.value_or(-1) << " "
            << check.limit.value_or(-1) << " " << check.why;
    EXPECT_EQ(all.verdict, Judgement::passes) << all.sentence;
    EXPECT_EQ(named(all, shaft).size(), 2U); // in the fixed frame and against the pedestal
    EXPECT_EQ(named(all, pedestal).size(), 2U);
    EXPECT_EQ(named(all, clearance).size(), 2U);
    EXPECT_FALSE(named(all, margin).empty());
    EXPECT_EQ(named(all, growth).size(), 1U);
    // By hand: velocity of a pedestal, omega times its amplitude, over the square root of 2; it
    // falls with the speed between the resonances or rises: the larger of the ends.
    const TwoMassMachine machine;
    const auto rms = [&](double s) {
        return s * std::abs(machine.at(s).pedestal) / std::numbers::sqrt2;
    };
    EXPECT_NEAR(*named(all, pedestal).front().value, std::max(rms(480), rms(580)), 1e-12);
    EXPECT_EQ(named(all, pedestal).front().quantity, model::Quantity::velocity);
    EXPECT_EQ(named(all, pedestal).front().reading, "rms");
    EXPECT_NEAR(*named(all, pedestal).front().margin(),
                1 - *named(all, pedestal).front().value / 10e-3, 1e-12);
    // Half of 60 um from peak to peak.
    EXPECT_DOUBLE_EQ(*named(all, shaft).front().limit, 30e-6);
    // The margin below: 17 (1 - 1/(AF - 1.5)) % at most 16 %.
    for (const Check &check : named(all, margin)) {
        EXPECT_TRUE(check.at_least && check.percent);
        EXPECT_GE(*check.value, *check.limit);
    }
}

TEST(Checks, ABrokenLimitFails) {
    model::Case scene = sound();
    scene.limits->velocity = 1e-5;
    const Assessment all = assess(scene);
    EXPECT_EQ(all.verdict, Judgement::fails);
    EXPECT_EQ(all.checks.front().name, pedestal); // what fails comes first
    EXPECT_LT(*all.checks.front().margin(), 0);
}

TEST(Checks, LimitsWithoutProbes) {
    model::Case scene = sound();
    scene.rotor.probes.clear();
    const Assessment all = assess(scene);
    expect_not_judged(all, shaft);
    EXPECT_EQ(all.verdict, Judgement::incomplete);
    expect_not_judged(all, clearance); // no probe to scale to
}

TEST(Checks, ProbesOnPedestalsReadNoShaft) {
    model::Case scene = sound();
    scene.rotor.probes = {{"on it", 0, 0, true, {}, 0}};
    expect_not_judged(assess(scene), shaft);
}

/// Peaks are looked for in [speeds]; the machine runs elsewhere.
TEST(Checks, OperatingSpeedsOutsideTheSpeeds) {
    model::Case scene = sound();
    for (const auto &[from, to] : {std::pair(0.0, 100.0), std::pair(0.0, 580.0),
                                   std::pair(500.0, 1500.0), std::pair(1400.0, 1500.0)}) {
        scene.speeds = model::SpeedRange{from, to, 31};
        const Assessment all = assess(scene);
        EXPECT_NE(all.verdict, Judgement::passes);
        EXPECT_TRUE(std::ranges::any_of(
            named(all, margin), [](const Check &check) { return !check.pass.has_value(); }));
        // What is looked for at the operating speeds themselves is judged all the same.
        EXPECT_TRUE(named(all, pedestal).front().pass.value_or(false));
    }
    scene.speeds = model::SpeedRange{500, 500, 1};
    EXPECT_NE(assess(scene).verdict, Judgement::passes);
}

/// A resonance inside the operating speeds, at none of the named ones.
TEST(Checks, PeakBetweenTheNamedSpeeds) {
    model::Case scene = sound();
    scene.operation = model::Operation{100, 560, 580};
    for (const int speeds : {31, 2}) {
        scene.speeds = model::SpeedRange{0, 1500, speeds};
        const Assessment all = assess(scene);
        EXPECT_EQ(all.verdict, Judgement::fails);
        expect_no_pass(all, shaft);
        EXPECT_EQ(named(all, factor).size(), 1U);
        EXPECT_EQ(named(all, factor).front().pass, std::optional(false));
    }
}

TEST(Checks, NoImbalanceThatCouldShowAnything) {
    for (const bool forces : {false, true}) {
        model::Case scene = sound();
        scene.rotor.imbalances.clear();
        if (forces)
            scene.rotor.forces = {{"", 0.5, 1e-6, 0, 2.0, {}, model::ForceDirection::forward}};
        else
            scene.response.gravity = 9.81; // so that there is a response
        const Assessment all = assess(scene);
        for (const std::string &name : {shaft, pedestal, clearance})
            expect_not_judged(all, name);
    }
    model::Case scene = sound();
    scene.rotor.imbalances.front().mr = 0;
    const Assessment all = assess(scene);
    for (const std::string &name : {shaft, pedestal, clearance})
        expect_not_judged(all, name);
}

/// A force of another frequency breaks a limit that the imbalance alone keeps; without imbalance it
/// breaks it too.
TEST(Checks, ForcesCount) {
    model::Case scene = sound();
    scene.rotor.forces = {{"", 0.5, 5e4, 0, {}, 300.0, model::ForceDirection::x}};
    const Assessment both = assess(scene);
    EXPECT_EQ(named(both, pedestal).front().pass, std::optional(false));
    scene.rotor.imbalances.clear();
    EXPECT_EQ(named(assess(scene), pedestal).front().pass, std::optional(false));
}

TEST(Checks, PedestalsWithoutProbesAreJudgedThemselves) {
    model::Case scene = sound();
    scene.rotor.probes.clear();
    scene.limits->shaft.reset();
    scene.limits->scaled = false;
    scene.limits->scale_most.reset();
    const Assessment all = assess(scene);
    EXPECT_EQ(named(all, pedestal).size(), 2U);
    EXPECT_EQ(all.verdict, Judgement::passes) << all.sentence;
}

TEST(Checks, BearingsThatStandStill) {
    model::Case scene = sound();
    scene.rotor.bearings[1].pedestal.reset();
    const Assessment one = assess(scene);
    EXPECT_EQ(std::ranges::count(named(one, pedestal), std::optional<bool>(), &Check::pass), 1);
    EXPECT_EQ(one.verdict == Judgement::passes, false);
    scene.rotor.bearings[0].pedestal.reset();
    expect_not_judged(assess(scene), pedestal);
}

TEST(Checks, ClearancesThatAreNotGiven) {
    model::Case scene = sound();
    scene.rotor.bearings[0].clearance.reset();
    const Assessment one = assess(scene);
    EXPECT_EQ(std::ranges::count(named(one, clearance), std::optional<bool>(), &Check::pass), 1);
    EXPECT_EQ(one.verdict, Judgement::incomplete);
    scene.rotor.bearings[1].clearance.reset();
    expect_not_judged(assess(scene), clearance);
}

/// Without the factor what is too large already fails, and nothing passes.
TEST(Checks, ClearancesWithoutAScale) {
    model::Case scene = sound();
    scene.limits->shaft.reset();
    scene.limits->scale_most.reset();
    expect_not_judged(assess(scene), clearance);
    scene.limits->clearance = 1e-6;
    for (const Check &check : named(assess(scene), clearance))
        EXPECT_EQ(check.pass, std::optional(false));
}

/// What touches fails also where the case gives no limit: an imbalance some thousand times as
/// large.
TEST(Checks, WhatTouchesNeedsNoLimit) {
    model::Case scene = sound();
    scene.limits.reset();
    EXPECT_TRUE(named(assess(scene), clearance).empty());
    for (model::Imbalance &imbalance : scene.rotor.imbalances)
        imbalance.mr *= 1e5;
    const Assessment all = assess(scene);
    EXPECT_EQ(all.verdict, Judgement::fails);
    const auto touching = named(all, clearance);
    ASSERT_FALSE(touching.empty());
    for (const Check &check : touching) {
        EXPECT_EQ(check.pass, std::optional(false));
        EXPECT_GE(*check.value, 1);
    }
}

TEST(Checks, BalancersAreLeftOutOfTheResponse) {
    model::Case scene = sound();
    model::Balancer balancer;
    balancer.z = 0.5;
    tests::row(balancer) = {2, 0.01, 0.05, 0.1};
    balancer.imbalance = 1e-4;
    scene.rotor.balancers = {balancer};
    const Assessment all = assess(scene);
    for (const std::string &name : {shaft, pedestal, clearance, margin})
        expect_not_judged(all, name);
}

/// The response of a machine that is unstable can be small all the same.
TEST(Checks, AnUnstableMachineWithASmallResponse) {
    model::Case scene = sound();
    for (model::Bearing &bearing : scene.rotor.bearings) {
        bearing.rows[0].k(0, 1) = 3e5;
        bearing.rows[0].k(1, 0) = -3e5;
    }
    const Analysed analysed(scene);
    const Assessment all = analysed.assess();
    EXPECT_EQ(all.verdict, Judgement::fails);
    ASSERT_EQ(named(all, growth).size(), 1U);
    EXPECT_EQ(named(all, growth).front().pass, std::optional(false));
    EXPECT_GT(*named(all, growth).front().value, 0);
    // Not looked at, it is not known.
    analyses::Computed without = analysed.computed;
    without.stability = nullptr;
    expect_not_judged(analyses::assess(scene, without), growth);
}

TEST(Checks, StabilityThatDoesNotCoverTheOperatingSpeeds) {
    Analysed analysed(sound());
    for (const auto &[from, to, count] :
         {std::tuple(0.0, 560.0, 20), std::tuple(490.0, 1000.0, 20), std::tuple(0.0, 100.0, 20),
          std::tuple(500.0, 500.0, 1)}) {
        model::Case there = analysed.scene;
        there.speeds = model::SpeedRange{from, to, count};
        const results::StabilityResult stability = analyses::stability(there, {});
        analyses::Computed computed = analysed.computed;
        computed.stability = &stability;
        expect_not_judged(analyses::assess(analysed.scene, computed), growth);
    }
}

TEST(Checks, NeitherGrowthNorDecay) {
    TwoMassMachine machine;
    machine.c = machine.pedestal_c = 0;
    model::Case scene = machine.scene();
    scene.operation = model::Operation{480, 560, 580};
    const Assessment all = assess(scene);
    expect_not_judged(all, growth);
}

TEST(Checks, StabilityThatIsNotKnown) {
    Analysed analysed(sound());
    results::StabilityResult stability = *analysed.stability;
    analyses::Computed computed = analysed.computed;
    computed.stability = &stability;
    const auto verdict = [&] { return analyses::assess(analysed.scene, computed); };
    stability.growth[3] = nan;
    expect_not_judged(verdict(), growth);
    stability = *analysed.stability;
    stability.verdict[3] = results::Verdict::unknown;
    expect_not_judged(verdict(), growth);
    stability = *analysed.stability;
    stability.unstable = {{510, 511}}; // between two speeds of the list
    EXPECT_EQ(verdict().verdict, Judgement::fails);
    stability.unstable = {{580, 700}}; // begins where the machine trips
    EXPECT_EQ(verdict().verdict, Judgement::fails);
    stability.unstable = {{600, 700}};
    stability.unstable_error = {{30, 1}};
    expect_not_judged(verdict(), growth);
    stability.unstable_error = {{nan, nan}};
    expect_not_judged(verdict(), growth);
}

/// Numbers that are none, or whose error is not known.
TEST(Checks, ValuesThatAreNotKnown) {
    Analysed analysed(sound());
    results::ResponseResult response = *analysed.response;
    analyses::Computed computed = analysed.computed;
    computed.response = &response;
    (*response.operating).worst.front().value = nan;
    EXPECT_NE(analyses::assess(analysed.scene, computed).verdict, Judgement::passes);
    response = *analysed.response;
    response.operating.reset();
    const Assessment none = analyses::assess(analysed.scene, computed);
    for (const std::string &name : {shaft, pedestal, clearance})
        expect_not_judged(none, name);
    computed.response = nullptr;
    computed.no_response = "it did not converge";
    const Assessment failed = analyses::assess(analysed.scene, computed);
    for (const std::string &name : {shaft, pedestal, clearance})
        expect_not_judged(failed, name);
    EXPECT_EQ(named(failed, shaft).front().why.text(), "it did not converge");
}

/// Nothing is known beyond the last row of a table.
TEST(Checks, TablesThatEndBelowTheTripSpeed) {
    model::Case scene = sound();
    for (model::Bearing &bearing : scene.rotor.bearings) {
        bearing.speeds = {0, 570};
        bearing.rows = {bearing.rows[0], bearing.rows[0]};
    }
    const Assessment all = assess(scene);
    for (const std::string &name : {shaft, pedestal, clearance, margin, growth})
        expect_not_judged(all, name);
    for (model::Bearing &bearing : scene.rotor.bearings)
        bearing.speeds = {0, 600};
    // A critical speed up to 1.26 times the maximum of 560 rad/s could be too near.
    const Assessment below = assess(scene);
    expect_not_judged(below, margin);
    for (const std::string &name : {shaft, pedestal, clearance, growth})
        EXPECT_TRUE(named(below, name).front().pass.value_or(false)) << name;
    for (model::Bearing &bearing : scene.rotor.bearings)
        bearing.speeds = {0, 800};
    EXPECT_EQ(assess(scene).verdict, Judgement::passes);
}

/// Two imbalances at one place that cancel drive nothing: small motions say nothing then.
TEST(Checks, ImbalancesThatCancel) {
    model::Case scene = sound();
    model::Imbalance opposite = scene.rotor.imbalances.front();
    opposite.phase += std::numbers::pi;
    scene.rotor.imbalances = {scene.rotor.imbalances.front(), opposite};
    const Assessment all = assess(scene);
    for (const std::string &name : {shaft, pedestal, clearance})
        expect_not_judged(all, name);
    EXPECT_EQ(all.verdict, Judgement::incomplete);
}

/// The critical speeds of a rotor whose inertias differ are found without their damping: without a
/// peak none is known to need no margin. Here sqrt(k/m) of 100 rad/s lies inside.
TEST(Checks, CriticalSpeedsOfUnknownDamping) {
    model::Case scene;
    scene.rotor.shaft = tests::uniform_shaft(1, 0.05, tests::weightless_steel());
    scene.rotor.shaft.rigid = true;
    scene.rotor.discs = {tests::disc_at(0.5, 100, 1, 1.5)};
    scene.rotor.bearings = {tests::isotropic_bearing(0, 5e5), tests::isotropic_bearing(1, 5e5)};
    for (model::Bearing &bearing : scene.rotor.bearings)
        bearing.rows[0].c = 5 * Eigen::Matrix2d::Identity();
    scene.speeds = model::SpeedRange{0, 400, 81};
    scene.operation = model::Operation{90, 115};
    model::Anisotropy unequal;
    unequal.z = 0.5;
    unequal.dI = 1e-3;
    scene.rotor.anisotropies = {unequal};
    const Assessment all = assess(scene);
    EXPECT_NE(all.verdict, Judgement::passes);
    for (const Check &check : named(all, margin))
        EXPECT_FALSE(check.pass.value_or(false)) << check.where.text();
}

// A critical speed below the range is always below the trip speed too: that is not why it fails.
TEST(Checks, AMarginOfAMotionThatGrowsSaysSo) {
    Analysed analysed(sound());
    ASSERT_TRUE(analysed.scene.operation.has_value());
    analysed.scene.operation->trip = 1.1 * analysed.scene.operation->to;
    results::ResponseResult response = *analysed.response;
    results::SeparationMargin grows;
    grows.speed = analysed.scene.operation->from / 2;
    grows.source = "damping";
    grows.side = results::MarginSide::below;
    grows.found = 50;
    grows.required = 16;
    grows.grows = true;
    response.margins = {grows};
    analyses::Computed computed = analysed.computed;
    computed.response = &response;
    const auto margins = named(analyses::assess(analysed.scene, computed), margin);
    const auto fails =
        std::ranges::find_if(margins, [](const Check &check) { return check.pass == false; });
    ASSERT_NE(fails, margins.end());
    EXPECT_NE(fails->where.find("where a free motion grows"), std::string::npos);
    EXPECT_EQ(fails->where.find("trips"), std::string::npos);
}

TEST(Checks, MarginsThatWereNotFound) {
    Analysed analysed(sound());
    analyses::Computed computed = analysed.computed;
    computed.critical = nullptr;
    const Assessment of_peaks = analyses::assess(analysed.scene, computed);
    EXPECT_NE(of_peaks.verdict, Judgement::passes);
    computed.response = nullptr;
    expect_not_judged(analyses::assess(analysed.scene, computed), margin);
    // A list that ends too early, or with gaps.
    results::CriticalResult critical = *analysed.critical;
    computed = analysed.computed;
    computed.critical = &critical;
    critical.complete.to = 600;
    EXPECT_EQ(analyses::assess(analysed.scene, computed).verdict, Judgement::incomplete);
    critical = *analysed.critical;
    critical.doubtful = {{500, 520}};
    EXPECT_EQ(analyses::assess(analysed.scene, computed).verdict, Judgement::incomplete);
    // A peak whose curve does not come down on both sides has no factor and no margin.
    results::ResponseResult response = *analysed.response;
    computed = analysed.computed;
    computed.response = &response;
    response.margins->clear();
    for (results::ResponsePeak &peak : response.peaks) {
        peak.amplification.reset();
        peak.speed = analysed.critical->critical_speeds.front().speed;
    }
    critical = *analysed.critical;
    for (results::CriticalSpeed &one : critical.critical_speeds)
        one.speed = 500;
    for (results::ResponsePeak &peak : response.peaks)
        peak.speed = 500;
    computed.critical = &critical;
    EXPECT_NE(analyses::assess(analysed.scene, computed).verdict, Judgement::passes);
}

TEST(Checks, WithoutOperatingSpeedsNothingIsJudged) {
    const model::Case scene = TwoMassMachine().scene();
    const Assessment all = analyses::assess(scene, {});
    EXPECT_EQ(all.verdict, Judgement::incomplete);
    ASSERT_EQ(all.checks.size(), 1U);
    EXPECT_FALSE(all.checks.front().why.empty());
    // But that it cannot run everywhere is said, and first.
    results::StabilityResult stability;
    stability.unstable = {{200, 300}, {500, 600}};
    stability.family.emplace();
    stability.family->unstable = {{250, 350}};
    analyses::Computed computed;
    computed.stability = &stability;
    const Assessment growing = analyses::assess(scene, computed);
    EXPECT_EQ(growing.verdict, Judgement::incomplete);
    ASSERT_EQ(growing.checks.size(), 2U);
    EXPECT_FALSE(growing.checks.front().pass);
    EXPECT_NE(growing.sentence.text().find("unstable from 200 to 350 rad/s, 500 to 600 rad/s"),
              std::string::npos)
        << growing.sentence.text();
}

TEST(Checks, LevelOne) {
    Analysed analysed(sound());
    analysed.scene.level1 = model::Level1Settings{};
    analysed.scene.level1->z = 0.5;
    analysed.scene.level1->count = 5;
    analysed.scene.level1->anticipated = 1e5;
    results::StabilityResult stability = *analysed.stability;
    analyses::Computed computed = analysed.computed;
    computed.stability = &stability;
    const std::string decrement = "logarithmic decrement with the anticipated cross coupling";
    const std::string ratio = "critical over anticipated cross coupling";
    const auto all = [&] { return analyses::assess(analysed.scene, computed); };
    expect_not_judged(all(), decrement);
    expect_not_judged(all(), ratio);
    results::Level1 found;
    found.z = 0.5;
    found.speed = 560;
    found.q = {0, 1e5};
    found.log_dec = {0.5, 0.3};
    found.frequency = {300, 300};
    found.anticipated = 1e5;
    found.anticipated_log_dec = 0.3;
    found.critical_cross_coupling = 2.5e5;
    found.error = 1e-6;
    found.gas_density = 10; // region A of the standard's figure
    found.critical_speed_ratio = 2;
    const auto with = [&](results::Level1 level1, const operation::Searched &searched = {1e6, {}}) {
        operation::add_verdict(level1, searched);
        stability.level1 = std::move(level1);
        return all();
    };
    EXPECT_EQ(named(with(found), decrement).front().pass, std::optional(true));
    EXPECT_DOUBLE_EQ(*named(with(found), ratio).front().value, 2.5);
    EXPECT_EQ(with(found).verdict, Judgement::passes);
    // Region A asks for nothing beyond the ratio: no row says that 2.5 passes a limit of 10.
    const std::string region = "critical over anticipated in region B of the standard";
    EXPECT_TRUE(named(with(found), region).empty());
    results::Level1 other = found;
    other.anticipated_log_dec = 0.09;
    EXPECT_EQ(with(other).verdict, Judgement::fails);
    other = found;
    other.anticipated_log_dec = nan;
    expect_not_judged(with(other), decrement);
    other = found;
    other.critical_cross_coupling = 1.9e5;
    EXPECT_EQ(with(other).verdict, Judgement::fails);
    other = found;
    other.error = nan;
    expect_not_judged(with(other), ratio);
    other = found;
    other.error = 0.5;
    expect_not_judged(with(other), ratio);
    other = found;
    other.critical_cross_coupling.reset(); // it never grows
    EXPECT_EQ(with(other).verdict, Judgement::passes);
    EXPECT_EQ(with(other, {1.5e5, {}}).verdict, Judgement::incomplete) << "tried up to there alone";
    EXPECT_EQ(with(other, {0, {}}).verdict, Judgement::fails) << "it grows without";
    other = found;
    other.anticipated.reset();
    expect_not_judged(with(other), ratio);
    expect_not_judged(with(other), decrement);
}

TEST(Checks, MarginOfACheck) {
    Check check;
    EXPECT_FALSE(check.margin().has_value());
    check.value = 3;
    check.limit = 4;
    EXPECT_DOUBLE_EQ(*check.margin(), 0.25);
    check.at_least = true;
    EXPECT_DOUBLE_EQ(*check.margin(), -0.25);
    check.value = infinite;
    EXPECT_FALSE(check.margin().has_value());
    check.value = nan;
    EXPECT_FALSE(check.margin().has_value());
    check.value = -1;
    check.limit = 0;
    EXPECT_FALSE(check.margin().has_value());
}

} // namespace
} // namespace checks_test
