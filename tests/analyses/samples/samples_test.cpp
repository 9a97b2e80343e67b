// Samples of rotors whose answers have closed forms.

#include "analyses/samples/samples.h"

#include "model/errors.h"
#include "process/parallel.h"
#include "results/samples.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace {

using namespace whirl;
using analyses::CaseWith;
using model::Distribution;
using results::SampledAnswer;
using results::SamplesResult;

constexpr double mass = 10;
constexpr double Id = 0.3;
constexpr double Ip = 0.1;
constexpr double rounding = 1e-9;

/// A disc on one spring that holds its tilt, too: sqrt(k/m), sqrt(kt/(Id + Ip)), sqrt(kt/(Id -
/// Ip)).
model::Case disc_on_spring() {
    model::Case scene;
    scene.rotor.shaft = tests::uniform_shaft(1, 0.05, tests::weightless_steel());
    scene.rotor.shaft.rigid = true;
    scene.rotor.discs = {tests::disc_at(0.5, mass, Id, Ip)};
    scene.rotor.bearings = {tests::isotropic_bearing(0.5, 1e7)};
    scene.rotor.bearings[0].rows[0].kt = 2e6 * Eigen::Matrix2d::Identity();
    model::SamplesSettings settings;
    settings.count = 60;
    settings.quantiles = {0.1, 0.5, 0.9};
    scene.samples = settings;
    return scene;
}

model::UncertainInput normal_input(const std::string &path, double mean, double deviation) {
    model::UncertainInput input;
    input.path = path;
    input.mean = mean;
    input.deviation = deviation;
    return input;
}

/// Entries "k", "kt", "c" and "dI" of a scene; a stiffness below zero is refused as the reader of
/// cases does.
CaseWith varied(const model::Case &scene) {
    return [scene](const std::vector<std::string> &overrides) {
        model::Case out = scene;
        for (const std::string &text : overrides) {
            const std::size_t equals = text.find('=');
            const std::string path = text.substr(0, equals);
            const double value = std::stod(text.substr(equals + 1));
            if (value < 0)
                throw model::BadInput("--set " + text + ": " + path +
                                      ": expected a stiffness in N/m, 0 or more, got " +
                                      std::to_string(value));
            auto &row = out.rotor.bearings[0].rows[0];
            (path == "k"    ? row.k
             : path == "kt" ? row.kt
                            : row.c) = value * Eigen::Matrix2d::Identity();
        }
        return out;
    };
}

const SampledAnswer &answer_named(const SamplesResult &result, const std::string &name) {
    for (const SampledAnswer &answer : result.answers)
        if (answer.name == name)
            return answer;
    throw std::runtime_error("no answer " + name);
}

/// The value at or below which this share of the values lies, by counting.
double counted_quantile(const std::vector<double> &values, double share) {
    double best = std::numeric_limits<double>::infinity();
    for (const double value : values) {
        const auto below =
            std::count_if(values.begin(), values.end(), [value](double x) { return x <= value; });
        if (static_cast<double>(below) >= share * static_cast<double>(values.size()) - 1e-9)
            best = std::min(best, value);
    }
    return best;
}

TEST(Samples, QuantilesOfAMonotoneAnswerAreThoseOfTheInput) {
    model::Case scene = disc_on_spring();
    scene.samples->vary = {normal_input("k", 1e7, 1e6), normal_input("kt", 2e6, 1e5)};
    const SamplesResult result = analyses::samples(scene, varied(scene));
    EXPECT_EQ(result.failed, 0);
    ASSERT_EQ(result.inputs.size(), 2U);
    ASSERT_EQ(result.answers.size(), 4U);
    const std::map<std::string, std::pair<std::size_t, double>> closed{{"forward 1", {0, mass}},
                                                                       {"backward 1", {0, mass}},
                                                                       {"backward 2", {1, Id + Ip}},
                                                                       {"forward 2", {1, Id - Ip}}};
    for (const auto &[name, of] : closed) {
        const SampledAnswer &answer = answer_named(result, name);
        const std::vector<double> &input = result.inputs[of.first].values;
        EXPECT_EQ(answer.of, "critical");
        EXPECT_EQ(answer.quantity, model::Quantity::speed);
        EXPECT_EQ(answer.present, 60);
        const double nominal = of.first == 0 ? 1e7 : 2e6;
        EXPECT_NEAR(*answer.nominal / std::sqrt(nominal / of.second), 1, rounding);
        EXPECT_LT(*answer.nominal_error, 1e-9);
        for (std::size_t i = 0; i < input.size(); ++i)
            EXPECT_NEAR(*answer.values[i] / std::sqrt(input[i] / of.second), 1, rounding);
        ASSERT_EQ(answer.quantiles.size(), 3U);
        for (const auto &quantile : answer.quantiles) {
            const double exact = std::sqrt(counted_quantile(input, quantile.share) / of.second);
            EXPECT_NEAR(quantile.value / exact, 1, rounding) << name << " " << quantile.share;
            // An end is there where it is less than 2.5 % likely that no sample lies beyond.
            const double rest = 1 - quantile.share;
            ASSERT_EQ(quantile.low.has_value(), std::pow(rest, 60) < 0.025) << quantile.share;
            ASSERT_EQ(quantile.high.has_value(), std::pow(quantile.share, 60) < 0.025)
                << quantile.share;
            if (quantile.low) {
                EXPECT_LT(*quantile.low, quantile.value);
            }
            if (quantile.high) {
                EXPECT_GT(*quantile.high, quantile.value);
            }
        }
    }
}

// The resonance of a Jeffcott rotor of damping ratio z: speed w/sqrt(1 - 2 z^2), radius
// e/(2 z sqrt(1 - z^2)).
TEST(Samples, PeaksAreThoseOfTheJeffcottRotor) {
    constexpr double mr = 1e-3;
    model::Case scene = disc_on_spring();
    scene.rotor.bearings[0].rows[0].c = 2000 * Eigen::Matrix2d::Identity();
    scene.rotor.imbalances = {tests::imbalance_at(0.5, mr)};
    scene.speeds = model::SpeedRange{0, 2000, 3};
    scene.samples->count = 20;
    scene.samples->of.critical = false;
    scene.samples->of.peaks = true;
    scene.samples->vary = {normal_input("k", 1e7, 1e6), normal_input("c", 2000, 200)};
    const SamplesResult result = analyses::samples(scene, varied(scene));
    EXPECT_EQ(result.failed, 0);
    const SampledAnswer &speed = answer_named(result, "station z = 0.5 m, peak 1, speed");
    const SampledAnswer &value = answer_named(result, "station z = 0.5 m, peak 1, value");
    EXPECT_EQ(speed.of, "peaks");
    EXPECT_EQ(value.quantity, model::Quantity::amplitude);
    for (std::size_t i = 0; i < 20; ++i) {
        const double k = result.inputs[0].values[i];
        const double natural = std::sqrt(k / mass);
        const double ratio = result.inputs[1].values[i] / (2 * mass * natural);
        EXPECT_NEAR(*speed.values[i] / (natural / std::sqrt(1 - 2 * ratio * ratio)), 1, rounding);
        EXPECT_NEAR(*value.values[i] / (mr / mass / (2 * ratio * std::sqrt(1 - ratio * ratio))), 1,
                    rounding);
    }
    EXPECT_EQ(answer_named(result, "bearing z = 0.5 m, peak 1, value").quantity,
              model::Quantity::force);
}

// Diametral inertias Id +- dI on an isotropic tilt stiffness: unstable between the two critical
// speeds, sqrt(kt/(Id +- dI - Ip)).
TEST(Samples, BandEndsAreThoseOfTheAnisotropicRotor) {
    constexpr double dI = 0.02;
    model::Case scene = disc_on_spring();
    scene.rotor.anisotropies = {{"", 0.5, dI, 0}};
    scene.speeds = model::SpeedRange{2000, 4000, 21};
    scene.samples->count = 10;
    scene.samples->of.critical = false;
    scene.samples->of.ends = true;
    scene.samples->vary = {normal_input("kt", 2e6, 5e4)};
    const SamplesResult result = analyses::samples(scene, varied(scene));
    EXPECT_EQ(result.failed, 0);
    ASSERT_EQ(result.answers.size(), 2U);
    for (const auto &[name, inertia] :
         {std::pair("band 1 from", Id + dI - Ip), std::pair("band 1 to", Id - dI - Ip)}) {
        const SampledAnswer &end = answer_named(result, name);
        EXPECT_EQ(end.of, "ends");
        for (std::size_t i = 0; i < 10; ++i)
            EXPECT_NEAR(*end.values[i] / std::sqrt(result.inputs[0].values[i] / inertia), 1, 1e-8);
    }
}

TEST(Samples, ThatFailAreListedWithTheirReason) {
    model::Case scene = disc_on_spring();
    scene.samples->vary = {normal_input("k", 1e6, 1e6)}; // a sixth is below zero
    const SamplesResult result = analyses::samples(scene, varied(scene));
    ASSERT_EQ(result.failures.size(), 1U); // one reason, whatever the values
    EXPECT_EQ(result.failures[0].message, "k: expected a stiffness in N/m, 0 or more");
    EXPECT_EQ(std::ssize(result.failures[0].samples), result.failed);
    const SampledAnswer &answer = answer_named(result, "forward 1");
    EXPECT_EQ(answer.present, result.count - result.failed);
    for (std::size_t i = 0; i < answer.values.size(); ++i) {
        const auto &failed = result.failures[0].samples;
        const bool listed = std::count(failed.begin(), failed.end(), static_cast<int>(i)) > 0;
        EXPECT_EQ(listed, result.inputs[0].values[i] < 0) << i;
        EXPECT_EQ(answer.values[i].has_value(), !listed) << i;
    }
    EXPECT_FALSE(result.model.notes.empty());
}

// Translation of an asymmetric rotor is the same in both directions: two equal critical speeds,
// which stay the first two in every sample. Tilt: sqrt(kt/(Id +- dI - Ip)).
TEST(Samples, DirectionsOfAnAsymmetricRotorKeepTheirNumbers) {
    constexpr double dI = 0.02;
    model::Case scene = disc_on_spring();
    scene.rotor.anisotropies = {{"", 0.5, dI, 0}};
    scene.samples->count = 10;
    scene.samples->vary = {normal_input("k", 1e7, 1e6), normal_input("kt", 2e6, 5e4)};
    const SamplesResult result = analyses::samples(scene, varied(scene));
    ASSERT_EQ(result.answers.size(), 4U);
    const std::vector<std::pair<std::size_t, double>> closed{
        {0, mass}, {0, mass}, {1, Id + dI - Ip}, {1, Id - dI - Ip}};
    for (std::size_t k = 0; k < 4; ++k) {
        const SampledAnswer &answer = result.answers[k];
        EXPECT_EQ(answer.name, "forward " + std::to_string(k + 1));
        const auto &[input, inertia] = closed[k];
        EXPECT_NEAR(*answer.nominal / std::sqrt((input == 0 ? 1e7 : 2e6) / inertia), 1, rounding);
        EXPECT_TRUE(answer.nominal_error) << k;
        for (std::size_t i = 0; i < 10; ++i)
            EXPECT_NEAR(*answer.values[i] / std::sqrt(result.inputs[input].values[i] / inertia), 1,
                        rounding);
    }
}

// A bound that depends on other entries that vary is another number in every sample.
TEST(Samples, ReasonsThatDifferInNumbersAreOne) {
    model::Case scene = disc_on_spring();
    scene.samples->vary = {normal_input("k", 1e7, 1e6)};
    const CaseWith with = [&](const std::vector<std::string> &overrides) {
        const double k = std::stod(overrides.at(0).substr(2));
        if (k > 1.1e7)
            throw model::BadInput("case.toml:9: disc[1].Id: expected at least " +
                                  std::to_string(k) + " kg m2, got 0");
        if (k < 0.9e7)
            throw model::BadInput("case.toml:9: disc[0].Id: expected at least 2e-5, got 0");
        return scene;
    };
    const SamplesResult result = analyses::samples(scene, with);
    EXPECT_EQ(result.failures.size(), 2U); // of two discs
}

TEST(Samples, AllFailedIsAFailureWithTheReason) {
    model::Case scene = disc_on_spring();
    scene.samples->vary = {normal_input("k", -1e7, 1)};
    try {
        (void)analyses::samples(scene, varied(scene));
        FAIL() << "no sample can be computed";
    } catch (const model::AnalysisFailure &failure) {
        EXPECT_NE(std::string(failure.what()).find("each of the 60 samples failed: k: expected"),
                  std::string::npos)
            << failure.what();
    }
}

TEST(Samples, WithoutTheirSectionAreBadInput) {
    model::Case scene = disc_on_spring();
    scene.samples.reset();
    EXPECT_THROW((void)analyses::samples(scene, varied(scene)), model::BadInput);
    scene = disc_on_spring();
    scene.samples->of.peaks = true; // without an imbalance
    scene.samples->vary = {normal_input("k", 1e7, 1e6)};
    EXPECT_THROW((void)analyses::samples(scene, varied(scene)), model::BadInput);
}

TEST(Deal, OutcomesAreInOrderAndAFailureIsThrown) {
    const auto outcomes = process::deal(5, "test", [](std::size_t piece) {
        return process::Outcome{std::vector<double>(piece, 0.5), std::string(piece, 'x')};
    });
    ASSERT_EQ(outcomes.size(), 5U);
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_EQ(outcomes[i].numbers.size(), i);
        EXPECT_EQ(outcomes[i].text, std::string(i, 'x'));
    }
    std::size_t done = 0;
    const auto failing = [&done](std::size_t piece) -> process::Outcome {
        ++done;
        if (piece == 2)
            throw model::AnalysisFailure("the third");
        return {};
    };
    EXPECT_THROW((void)process::deal(5, "test", failing), model::AnalysisFailure);
    EXPECT_EQ(done, 3U); // nobody goes on
}

} // namespace
