// Standard runs: each is the case with its imbalances and tables written out, and the worst of them
// counts in the checks.

#include "analyses/standard/standard_runs.h"

#include "analyses/checks/checks.h"
#include "analyses/critical.h"
#include "analyses/response.h"
#include "analyses/stability.h"
#include "model/rpm.h"
#include "model/variants.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace standard_runs_test {
namespace {

using namespace whirl;
using analyses::response_with_runs;
using analyses::unbalance_response;
using model::BearingFit;
using results::OperatingResponse;
using results::ResponseResult;
using results::StandardRun;

constexpr double pi = std::numbers::pi;

/// 1 m of a 40 mm shaft on two stiff bearings at its ends. As a slender beam on simple supports its
/// n-th critical speed is (n pi)^2 sqrt(EI/(rho A)), EI/(rho A) = E d^2/(16 rho):
/// n = 1: 499.8 rad/s, n = 2: 1999 rad/s (bearings, shear and tilting change that by 2 %).
model::Case slender() {
    model::Case scene;
    scene.rotor.shaft = tests::uniform_shaft(1, 0.04, tests::steel());
    scene.rotor.bearings = {tests::isotropic_bearing(0, 1e9, 2e5),
                            tests::isotropic_bearing(1, 1e9, 2e5)};
    for (model::Bearing &bearing : scene.rotor.bearings)
        bearing.clearance = 2e-4;
    scene.rotor.probes = {{"mid", 0.4, 0.3}, {"DE", 0.1, 0.3}};
    scene.rotor.imbalances = {tests::imbalance_at(0.3, 2e-6)};
    scene.speeds = model::SpeedRange{0, 3000, 31};
    scene.operation = model::Operation{700, 1600, 1700};
    scene.limits.emplace();
    scene.limits->shaft = 25e-6;
    scene.limits->clearance = 0.75;
    scene.standard = model::StandardSettings{true, {BearingFit::given}};
    return scene;
}

void expect_close(double value, double expected, const std::string &what) {
    // The same equations; searches for largest values end in other digits.
    EXPECT_NEAR(value, expected, 1e-9 * std::abs(expected) + 1e-300) << what;
}

void expect_same(const OperatingResponse &found, const OperatingResponse &expected) {
    ASSERT_EQ(found.rows.size(), expected.rows.size());
    ASSERT_FALSE(found.rows.empty());
    for (std::size_t i = 0; i < found.rows.size(); ++i) {
        EXPECT_EQ(found.rows[i].speed, expected.rows[i].speed);
        EXPECT_EQ(found.rows[i].of, expected.rows[i].of);
        EXPECT_EQ(found.rows[i].z, expected.rows[i].z);
        expect_close(found.rows[i].amplitude, expected.rows[i].amplitude, found.rows[i].name);
        EXPECT_EQ(found.rows[i].pass, expected.rows[i].pass);
    }
    ASSERT_EQ(found.worst.size(), expected.worst.size());
    for (std::size_t i = 0; i < found.worst.size(); ++i) {
        expect_close(found.worst[i].value, expected.worst[i].value, found.worst[i].name);
        EXPECT_EQ(found.worst[i].limit, expected.worst[i].limit);
        EXPECT_EQ(found.worst[i].pass, expected.worst[i].pass);
        expect_close(found.worst[i].scale, expected.worst[i].scale, "scale");
    }
    ASSERT_EQ(found.scale.has_value(), expected.scale.has_value());
}

/// A run is the response of a case.
void expect_same(const StandardRun &run, const ResponseResult &expected) {
    ASSERT_TRUE(expected.operating && expected.margins);
    expect_same(run.operating, *expected.operating);
    ASSERT_EQ(run.peaks.size(), expected.peaks.size());
    for (std::size_t i = 0; i < run.peaks.size(); ++i) {
        expect_close(run.peaks[i].speed, expected.peaks[i].speed, "peak");
        expect_close(run.peaks[i].value, expected.peaks[i].value, "peak");
    }
    ASSERT_EQ(run.margins.size(), expected.margins->size());
    for (std::size_t i = 0; i < run.margins.size(); ++i) {
        expect_close(run.margins[i].found, (*expected.margins)[i].found, "margin");
        EXPECT_EQ(run.margins[i].passes, (*expected.margins)[i].passes);
        EXPECT_EQ(run.margins[i].name, (*expected.margins)[i].name);
    }
}

TEST(StandardRuns, PlacesOfAUniformShaftOnStiffBearings) {
    const ResponseResult found = response_with_runs(slender());
    ASSERT_EQ(found.runs.size(), 2U);
    const StandardRun &first = found.runs[0];
    const StandardRun &second = found.runs[1];
    EXPECT_EQ(first.name, "first bending");
    EXPECT_EQ(second.name, "second bending");
    EXPECT_EQ(first.fit, BearingFit::given);
    // sin(pi z) and sin(2 pi z), but for bearings that give and stations that are some way apart.
    constexpr double of_shape = 2e-3;
    ASSERT_EQ(first.unbalance.size(), 1U);
    EXPECT_NEAR(first.unbalance[0].z, 0.5, of_shape);
    ASSERT_EQ(second.unbalance.size(), 2U);
    EXPECT_NEAR(second.unbalance[0].z, 0.25, of_shape);
    EXPECT_NEAR(second.unbalance[1].z, 0.75, of_shape);
    EXPECT_NEAR(second.unbalance[1].phase - second.unbalance[0].phase, pi, 1e-12);
    // 7800 * pi/4 * 0.04^2 = 9.80177 kg, 1600 rad/s = 15278.87 rpm: 2 * 6350 * 9.80177 / 15278.87
    // = 8.1474 g mm.
    EXPECT_NEAR(first.unbalance[0].mr, 8.1474e-6, 1e-10);
    EXPECT_NEAR(second.unbalance[0].mr, 8.1474e-6 / 2, 1e-10);
    ASSERT_EQ(first.placed_by.size(), 1U);
    EXPECT_NEAR(first.placed_by[0], 499.8, 0.02 * 499.8);
    EXPECT_NEAR(second.placed_by.at(0), 1999, 0.03 * 1999);
}

TEST(StandardRuns, EachIsTheCaseWithItsImbalancesWrittenOut) {
    const model::Case scene = slender();
    const ResponseResult found = response_with_runs(scene);
    model::Case plain = scene;
    plain.standard.reset();
    for (const StandardRun &run : found.runs) {
        plain.rotor.imbalances = run.unbalance;
        expect_same(run, unbalance_response(plain));
    }
    // The response itself is that to the imbalances of the case.
    plain.rotor.imbalances = scene.rotor.imbalances;
    EXPECT_FALSE(found.of_first_run);
    expect_same(*found.operating, *unbalance_response(plain).operating);
    ASSERT_TRUE(found.worst_run.has_value());
    EXPECT_NE(found.worst_run_text.find(found.runs[*found.worst_run].name), std::string::npos);
}

TEST(StandardRuns, WithoutImbalanceOfTheCaseTheFirstIsShown) {
    model::Case scene = slender();
    scene.rotor.imbalances.clear();
    const ResponseResult found = response_with_runs(scene);
    EXPECT_TRUE(found.of_first_run);
    ASSERT_EQ(found.runs.size(), 2U);
    expect_same(found.runs[0].operating, *found.operating);
}

TEST(StandardRuns, TheLowestModeWhereNoneIsLow) {
    model::Case scene = slender();
    scene.operation = model::Operation{100, 300}; // 1.26 times 300 is below 490
    const ResponseResult found = response_with_runs(scene);
    ASSERT_EQ(found.runs.size(), 1U);
    EXPECT_EQ(found.runs[0].name, "first bending");
    EXPECT_GT(found.runs[0].placed_by.at(0), 378);
}

/// Tables of a minimum and a maximum clearance: stiff with little damping, soft with much.
model::Case with_tables() {
    model::Case scene = slender();
    for (model::Bearing &bearing : scene.rotor.bearings) {
        const auto table = [](double k, double c) {
            model::BearingCoefficients row;
            row.k = k * Eigen::Matrix2d::Identity();
            row.c = c * Eigen::Matrix2d::Identity();
            model::BearingCoefficients faster = row;
            faster.k *= 1.2;
            faster.c *= 0.8;
            return model::BearingAtClearance{{0, 3000}, {row, faster}, {}};
        };
        const auto given = table(2e7, 2e4);
        bearing.speeds = given.speeds;
        bearing.rows = given.rows;
        bearing.least = table(4e7, 3e4);
        bearing.least->clearance = 1.2e-4;
        bearing.most = table(1e7, 1e4);
    }
    scene.standard->fits = {BearingFit::least, BearingFit::most};
    return scene;
}

TEST(StandardRuns, TablesOfClearancesAreCasesOfTheirOwn) {
    const model::Case scene = with_tables();
    const ResponseResult found = response_with_runs(scene);
    ASSERT_EQ(found.runs.size() % 2, 0U);
    const std::size_t half = found.runs.size() / 2;
    for (std::size_t i = 0; i < found.runs.size(); ++i) {
        const StandardRun &run = found.runs[i];
        EXPECT_EQ(run.fit, i < half ? BearingFit::least : BearingFit::most);
        EXPECT_EQ(run.name, found.runs[i % half].name);
        model::Case plain = scene;
        plain.standard.reset();
        plain.rotor.imbalances = run.unbalance;
        for (model::Bearing &bearing : plain.rotor.bearings) {
            const auto own = i < half ? bearing.least : bearing.most;
            bearing.rows = own->rows;
            bearing.clearance = i < half ? 1.2e-4 : 2e-4; // the latter as of the bearing
            bearing.least.reset();
            bearing.most.reset();
        }
        expect_same(run, unbalance_response(plain));
    }
}

/// Value over limit, of a limit that is broken above all others.
double use_of(const results::OperatingWorst &worst) {
    return worst.value / worst.limit + (worst.pass.has_value() && !*worst.pass ? 1e3 : 0);
}

TEST(StandardRuns, TheWorstUsesMostOfALimit) {
    const ResponseResult found = response_with_runs(with_tables());
    std::size_t worst = 0;
    double most = 0;
    for (std::size_t i = 0; i < found.runs.size(); ++i)
        for (const auto &one : found.runs[i].operating.worst)
            if (use_of(one) > most) {
                most = use_of(one);
                worst = i;
            }
    ASSERT_GT(most, 0);
    EXPECT_EQ(found.worst_run, worst);
}

/// With the bearings of one clearance and nothing of [standard].
model::Case with_fit(model::Case scene, BearingFit fit) {
    scene.rotor = model::with_fit(std::move(scene.rotor), fit);
    scene.standard.reset();
    return scene;
}

TEST(StandardRuns, StabilityOfEachClearanceIsThatOfACaseOfItsOwn) {
    model::Case scene = analyses::over_operation(with_tables());
    scene.level1 = model::Level1Settings{.z = 0.5, .anticipated = 1e4};
    const auto all = analyses::stability(scene, {});
    ASSERT_EQ(all.clearances.size(), 2U);
    double largest = results::largest_growth(all);
    double coupling = *all.level1->critical_cross_coupling;
    for (std::size_t i : {0U, 1U}) {
        const results::StabilityResult &one = all.clearances[i];
        EXPECT_EQ(one.fit, i == 0 ? BearingFit::least : BearingFit::most);
        const auto own = analyses::stability(with_fit(scene, one.fit), {});
        ASSERT_EQ(one.growth.size(), own.growth.size());
        for (std::size_t k = 0; k < own.growth.size(); ++k)
            expect_close(one.growth[k], own.growth[k], "growth");
        expect_close(*one.level1->critical_cross_coupling, *own.level1->critical_cross_coupling,
                     "critical cross coupling");
        // The tables tell the three apart: a case judged by one of them would be another.
        EXPECT_GT(std::abs(*one.level1->critical_cross_coupling / coupling - 1), 1e-3);
        largest = std::max(largest, results::largest_growth(one));
        coupling = std::min(coupling, *one.level1->critical_cross_coupling);
    }
    EXPECT_EQ(*results::least_stable(all).level1->critical_cross_coupling, coupling);
    // The checks are those of the worst, named.
    const ResponseResult response = response_with_runs(scene);
    const auto critical = analyses::critical_speeds(scene, false, &response.peaks);
    const auto assessment = analyses::assess(scene, {&response, &critical, &all, {}, {}, {}});
    const auto check = [&](const std::string &name) {
        return *std::ranges::find(assessment.checks, name, &results::Check::name);
    };
    EXPECT_EQ(check("growth of free motions").value, largest);
    const results::Check ratio = check("critical over anticipated cross coupling");
    expect_close(*ratio.value, coupling / 1e4, "critical over anticipated");
    EXPECT_NE(ratio.where.find("clearance " + model::fit_name(results::least_stable(all).fit)),
              std::string::npos)
        << ratio.where;
}

TEST(StandardRuns, ClearancesAloneHaveTheImbalancesOfTheCase) {
    model::Case scene = with_tables();
    scene.standard->api617 = false;
    const ResponseResult found = response_with_runs(scene);
    ASSERT_EQ(found.runs.size(), 2U);
    for (const StandardRun &run : found.runs) {
        EXPECT_EQ(run.name, "imbalance of the case");
        ASSERT_EQ(run.unbalance.size(), 1U);
        EXPECT_EQ(run.unbalance[0].mr, 2e-6);
    }
}

/// Checks of a name.
std::vector<results::Check> named(const results::Assessment &all, const std::string &name) {
    std::vector<results::Check> out;
    std::ranges::copy_if(all.checks, std::back_inserter(out),
                         [&name](const auto &check) { return check.name == name; });
    return out;
}

results::Assessment assessed(const model::Case &scene, const ResponseResult &response) {
    const auto critical = analyses::critical_speeds(scene, false, &response.peaks);
    const auto stability = analyses::stability(analyses::over_operation(scene), {});
    return analyses::assess(scene, {&response, &critical, &stability, {}, {}, {}});
}

TEST(StandardRuns, ChecksAreThoseOfTheWorst) {
    const model::Case scene = with_tables();
    const ResponseResult found = response_with_runs(scene);
    const auto all = assessed(scene, found);
    for (const auto &[check_name, what] :
         {std::pair("vibration of the shaft", results::Measure::amplitude),
          {"share of the clearance", results::Measure::clearance_share}}) {
        const auto checks = named(all, check_name);
        ASSERT_EQ(checks.size(), 2U) << check_name; // two probes, two bearings
        for (const auto &check : checks) {
            // By hand: the largest of its place in all runs and in the response of the case.
            double largest = 0;
            std::string of;
            const auto look = [&, measure = what](const OperatingResponse &operating,
                                                  const std::string &name) {
                for (const auto &worst : operating.worst)
                    if (worst.what == measure && worst.value > largest &&
                        (worst.name.empty()
                             ? check.where.find(worst.z == 0 ? "z = 0 m" : "z = 1 m")
                             : check.where.find("probe " + worst.name)) != std::string::npos) {
                        largest = worst.value;
                        of = name;
                    }
            };
            look(*found.operating, "imbalance of the case");
            for (const StandardRun &run : found.runs)
                look(run.operating, results::run_name(run).text());
            EXPECT_EQ(*check.value, largest) << check.where;
            EXPECT_NE(check.where.find(of), std::string::npos) << check.where << ": " << of;
        }
    }
    // Of the margins that of the least: a fail of one run fails.
    bool fails = false;
    for (const StandardRun &run : found.runs)
        for (const auto &margin : run.margins)
            fails = fails || !margin.passes;
    const auto margins = named(all, "separation margin");
    EXPECT_EQ(
        std::ranges::any_of(margins,
                            [](const auto &check) { return check.pass && !*check.pass; }) ||
            !named(all, "amplification factor of a critical speed at operating speeds").empty(),
        fails);
}

TEST(StandardRuns, OneBadRunFailsTheMachine) {
    const model::Case scene = slender();
    ResponseResult found = response_with_runs(scene);
    const auto before = assessed(scene, found);
    auto &worst = found.runs[1].operating.worst.at(0);
    worst.value = 10 * worst.limit;
    worst.pass = false;
    const auto after = assessed(scene, found);
    EXPECT_EQ(after.verdict, results::Judgement::fails);
    EXPECT_EQ(after.checks.size(), before.checks.size());
    EXPECT_NE(after.checks.front().where.find("run second bending"), std::string::npos);
    // Nothing placed: said, and nothing passes.
    found.runs.clear();
    found.no_runs = {"no shape"};
    const auto none = named(assessed(scene, found), "standard runs");
    ASSERT_EQ(none.size(), 1U);
    EXPECT_FALSE(none[0].pass.has_value());
}

} // namespace
} // namespace standard_runs_test
