// Sweeps over entries whose answers have closed forms.

#include "analyses/sweep.h"

#include "analyses/critical.h"
#include "model/errors.h"
#include "results/sweep.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace {

using namespace whirl;
using analyses::CaseWith;
using results::SampledAnswer;
using results::SweepResult;

constexpr double swept_mass = 8;
constexpr double swept_rounding = 1e-9; // of closed forms of a rigid rotor: a few hundred roundings

/// A disc that does not tilt on one isotropic spring k with a damper c: sqrt(k/m), backward and
/// forward, and the damping ratio c/(2 sqrt(k m)).
model::Case swept_disc() {
    model::Case scene;
    scene.rotor.shaft = tests::uniform_shaft(1, 0.05, tests::weightless_steel());
    scene.rotor.shaft.rigid = true;
    scene.rotor.discs = {tests::disc_at(0.5, swept_mass, 0.3, 0.1)};
    scene.rotor.bearings = {tests::isotropic_bearing(0.5, 1e6)};
    scene.rotor.bearings[0].rows[0].kt = 1e9 * Eigen::Matrix2d::Identity();
    scene.campbell.modes = 2;
    return scene;
}

/// Entries "k", "c" and "m".
CaseWith swept(const model::Case &scene) {
    return [scene](const std::vector<std::string> &overrides) {
        model::Case out = scene;
        for (const std::string &text : overrides) {
            const std::string path = text.substr(0, text.find('='));
            const double value = std::stod(text.substr(text.find('=') + 1));
            if (value < 0)
                throw model::BadInput("--set " + text + ": " + path + ": expected 0 or more");
            auto &row = out.rotor.bearings[0].rows[0];
            if (path == "m")
                out.rotor.discs[0].mass = value;
            else
                (path == "k" ? row.k : row.c) = value * Eigen::Matrix2d::Identity();
        }
        return out;
    };
}

const SampledAnswer &swept_answer(const SweepResult &result, const std::string &name) {
    for (const SampledAnswer &answer : result.answers)
        if (answer.name.text().starts_with(name))
            return answer;
    throw std::runtime_error("no answer " + name);
}

TEST(Sweep, TwoEntriesRunTheFirstFastest) {
    model::Case scene = swept_disc();
    model::SweepSettings settings;
    settings.axes = {
        {"k", {{"k", 1e6}}, model::SweepChange::factor, model::Quantity::number, {1, 4, 9}},
        {"m", {{"m", 0}}, model::SweepChange::value, model::Quantity::mass, {2, 8}}};
    scene.sweep = settings;
    const SweepResult result = analyses::sweep(scene, swept(scene));
    EXPECT_EQ(result.count, 6);
    EXPECT_EQ(result.failed, 0);
    const SampledAnswer &first = swept_answer(result, "1");
    ASSERT_EQ(first.values.size(), 6U);
    for (std::size_t i = 0; i < 6; ++i) {
        const double k = 1e6 * std::vector{1.0, 4.0, 9.0}[i % 3];
        const double m = i < 3 ? 2 : 8;
        EXPECT_NEAR(first.values[i].value() / std::sqrt(k / m), 1, swept_rounding) << i;
    }
    EXPECT_NEAR(first.nominal.value() / std::sqrt(1e6 / swept_mass), 1, swept_rounding);
}

// log dec = 2 pi z / sqrt(1 - z^2) at every speed: the disc does not tilt.
TEST(Sweep, DampingIsThatOfTheDamper) {
    model::Case scene = swept_disc();
    scene.rotor.bearings[0].rows[0].c = 100 * Eigen::Matrix2d::Identity();
    model::SweepSettings settings;
    settings.of.critical = false;
    settings.of.damping = true;
    settings.of.at = {50};
    settings.axes = {
        {"c", {{"c", 100}}, model::SweepChange::shift, model::Quantity::damping, {0, 100, 900}}};
    scene.sweep = settings;
    const SweepResult result = analyses::sweep(scene, swept(scene));
    for (const char *name : {"mode 1", "mode 2", "least damped mode"}) {
        const SampledAnswer &answer = swept_answer(result, name);
        for (std::size_t i = 0; i < 3; ++i) {
            const double c = 100 + settings.axes[0].values[i];
            const double z = c / (2 * std::sqrt(1e6 * swept_mass));
            const double log_dec = 2 * std::numbers::pi * z / std::sqrt(1 - z * z);
            EXPECT_NEAR(answer.values[i].value() / log_dec, 1, 1e-8) << name; // a root of the pair
        }
    }
}

// A critical speed at sqrt(k/m) without response: (from - speed)/from of API 617's margin.
TEST(Sweep, MarginsAreToTheNearerEndOfTheOperatingSpeeds) {
    model::Case scene = swept_disc();
    scene.operation = model::Operation{500, 800, std::nullopt};
    model::SweepSettings settings;
    settings.of.critical = false;
    settings.of.margins = true;
    settings.axes = {
        {"k", {{"k", 1e6}}, model::SweepChange::value, model::Quantity::stiffness, {1e6, 8e6}}};
    scene.sweep = settings;
    const SweepResult result = analyses::sweep(scene, swept(scene));
    const SampledAnswer &nearest = swept_answer(result, "the nearest");
    EXPECT_NEAR(nearest.values[0].value(), 100 * (1 - std::sqrt(1e6 / swept_mass) / 500), 1e-6);
    EXPECT_NEAR(nearest.values[1].value(), 100 * (std::sqrt(8e6 / swept_mass) / 800 - 1), 1e-6);
    // And that of the one forward mode, as `critical` has it: not of the tilt modes, which the case
    // does not ask for.
    EXPECT_EQ(analyses::critical_speeds(scene).margins.value().size(), 1U);
    EXPECT_EQ(result.answers.size(), 2U);
}

// m x'' + c x' + k x = U W^2 exp(i W t): |x| = U W^2 / |k - m W^2 + i c W|, and the spring and
// damper carry |k + i c W| |x|.
TEST(Sweep, AmplitudesAndForcesWhereTheMachineRuns) {
    model::Case scene = swept_disc();
    constexpr double c = 100, U = 1e-4, W = 800;
    scene.rotor.bearings[0].rows[0].c = c * Eigen::Matrix2d::Identity();
    scene.rotor.imbalances = {tests::imbalance_at(0.5, U, 0.4)};
    scene.rotor.probes.push_back({"x", 0.5, 0});
    scene.operation = model::Operation{500, W, std::nullopt};
    model::SweepSettings settings;
    settings.of.critical = false;
    settings.of.operating = true;
    settings.axes = {
        {"k", {{"k", 1e6}}, model::SweepChange::value, model::Quantity::stiffness, {1e6, 8e6}}};
    scene.sweep = settings;
    const SweepResult result = analyses::sweep(scene, swept(scene));
    for (std::size_t i = 0; i < 2; ++i) {
        const double k = settings.axes[0].values[i];
        const double x = U * W * W / std::hypot(k - swept_mass * W * W, c * W);
        const auto named = [&](const std::string &of, const std::string &what) {
            for (const SampledAnswer &answer : result.answers)
                if (const std::string name = answer.name.text();
                    name.starts_with(of) && name.ends_with("maximum speed, " + what))
                    return answer.values[i].value();
            throw std::runtime_error("no answer of " + of);
        };
        EXPECT_NEAR(named("probe x", "amplitude") / x, 1, swept_rounding);
        EXPECT_NEAR(named("bearing", "amplitude") / x, 1, swept_rounding);
        EXPECT_NEAR(named("bearing", "force") / (std::hypot(k, c * W) * x), 1, swept_rounding);
    }
    for (const SampledAnswer &answer : result.answers) // which this rotor has none of
        EXPECT_EQ(answer.name.text().find("pedestal"), std::string::npos) << answer.name;
    scene.rotor.imbalances.clear();
    EXPECT_THROW((void)analyses::sweep(scene, swept(scene)), model::BadInput);
}

TEST(Sweep, RotorsThatCannotBeAreListed) {
    model::Case scene = swept_disc();
    model::SweepSettings settings;
    settings.axes = {
        {"k", {{"k", 0}}, model::SweepChange::value, model::Quantity::stiffness, {-1, 1e6, -2}}};
    scene.sweep = settings;
    const SweepResult result = analyses::sweep(scene, swept(scene));
    EXPECT_EQ(result.failed, 2);
    ASSERT_EQ(result.failures.size(), 1U);
    EXPECT_EQ(result.failures[0].samples, (std::vector<int>{0, 2}));
    const SampledAnswer &first = swept_answer(result, "1");
    EXPECT_FALSE(first.values[0]);
    EXPECT_TRUE(first.values[1]);
    scene.sweep->axes[0].values = {-1};
    EXPECT_THROW((void)analyses::sweep(scene, swept(scene)), model::AnalysisFailure);
    scene.sweep.reset();
    EXPECT_THROW((void)analyses::sweep(scene, swept(scene)), model::BadInput);
}

} // namespace
