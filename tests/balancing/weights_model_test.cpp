// Correction weights of a model: a compressor with hidden imbalance, whose response `response`
// computes.

#include "analyses/critical.h"
#include "analyses/response.h"
#include "analyses/weights.h"
#include "balancing/measured_case.h"
#include "input/case_file.h"
#include "model/errors.h"

#include <algorithm>
#include <cmath>

namespace whirl::tests::modelled {

namespace {

constexpr double rpm = std::numbers::pi / 30;
const std::vector<double> speeds{6000, 9000, 11000};
const std::vector<double> plane_places{0.44, 0.9, 1.35};

/// The compressor of cases/ with hidden imbalance in four places and three planes.
model::Case compressor() {
    model::Case scene = input::load_case(WHIRL_ROOT "/cases/compressor_margins");
    scene.rotor.imbalances = {{"", 0.5, 2e-4, 0.7},
                              {"", 0.83, 3e-4, -1.9},
                              {"", 1.22, 1.5e-4, 2.4},
                              {"", 1.4, 1e-4, 0.2}};
    for (std::size_t p = 0; p < plane_places.size(); ++p) {
        model::CorrectionPlane plane;
        plane.name = fmt::format("plane {}", p);
        plane.z = plane_places[p];
        scene.rotor.planes.push_back(plane);
    }
    scene.rotor.probes.push_back({"mid", 0.96, 0.3});
    return scene;
}

/// What the probes read with more imbalances, at one speed.
std::vector<Phasor> readings(model::Case scene, double speed,
                             const std::vector<model::Imbalance> &more) {
    scene.rotor.imbalances.insert(scene.rotor.imbalances.end(), more.begin(), more.end());
    for (const double z : plane_places) // the same mesh, whatever is on it
        scene.rotor.stations.push_back({z});
    scene.speeds = model::SpeedRange{speed * rpm, speed * rpm, 1};
    scene.operation.reset();
    std::vector<Phasor> out;
    for (const results::ResponseProbe &probe : analyses::unbalance_response(scene).probes)
        out.push_back(std::polar(probe.amplitude[0], probe.phase[0]));
    return out;
}

/// Readings of an initial run and of one trial run a plane, as tables. @param lag  their phases
std::string table_of(const model::Case &scene, bool lag, bool trials = true) {
    std::string text = "speed [rpm],probe,run,amplitude [m],phase [deg]\n";
    for (const double speed : speeds)
        for (std::size_t run = 0; run <= (trials ? plane_places.size() : 0); ++run) {
            std::vector<model::Imbalance> more;
            if (run > 0)
                more.push_back({"", plane_places[run - 1], 1e-4, 0.5 * static_cast<double>(run)});
            const std::vector<Phasor> values = readings(scene, speed, more);
            for (std::size_t k = 0; k < values.size(); ++k)
                text += fmt::format("{},{},{},{}\n", speed, scene.rotor.probes[k].name,
                                    run == 0 ? "initial" : fmt::format("t{}", run),
                                    cells_of(lag ? std::conj(values[k]) : values[k]));
        }
    return text;
}

std::string measured_text(bool lag) {
    std::string text = fmt::format(
        "format = 1\n[weights]\nreadings = \"runs.csv\"\nphase = \"{}\"\n", lag ? "lag" : "lead");
    for (std::size_t p = 0; p < plane_places.size(); ++p)
        text += fmt::format("[[plane]]\nname = \"plane {0}\"\n[[trial]]\nrun = \"t{1}\"\n"
                            "plane = \"plane {0}\"\nmr = 1e-4\nphase = {2}\n",
                            p, p + 1, (lag ? -0.5 : 0.5) * static_cast<double>(p + 1));
    return text;
}

std::vector<model::Imbalance> set(const results::WeightsResult &result, bool lag = false) {
    std::vector<model::Imbalance> out;
    for (std::size_t p = 0; p < plane_places.size(); ++p) {
        const Phasor weight = result.weights[p].weight;
        out.push_back(
            {"", plane_places[p], std::abs(weight), lag ? -std::arg(weight) : std::arg(weight)});
    }
    return out;
}

/// The response with the weights set is the residual that was told.
void expect_predicted(const model::Case &scene, const results::WeightsResult &result, bool lag,
                      double share) {
    std::size_t row = 0;
    for (const double speed : speeds) {
        const std::vector<Phasor> before = readings(scene, speed, {});
        const std::vector<Phasor> after = readings(scene, speed, set(result, lag));
        for (std::size_t k = 0; k < after.size(); ++k, ++row) {
            const Phasor told = result.residual.at(row).after;
            EXPECT_LE(std::abs((lag ? std::conj(told) : told) - after[k]),
                      share * std::abs(before[k]))
                << speed << " rpm, probe " << k;
        }
    }
}

TEST(WeightsOfACompressor, FromSimulatedReadingsLeaveWhatIsPredicted) {
    const model::Case scene = compressor();
    for (const bool lag : {false, true}) {
        const auto result = analyses::correction_weights(
            measured_case(measured_text(lag), {{"runs.csv", table_of(scene, lag)}}));
        expect_predicted(scene, result, lag, 1e-8);
        EXPECT_LT(result.rms, 0.5 * result.rms_before);
    }
}

model::Case from_model(const model::Case &scene) {
    model::Case out = scene;
    model::WeightsSettings settings;
    for (const double speed : speeds)
        settings.speeds.push_back(speed * rpm);
    out.weights = settings;
    return out;
}

/// Readings and model are two ways to one answer.
TEST(WeightsOfACompressor, FromTheModelAreThoseFromReadings) {
    const model::Case scene = compressor();
    const auto measured = analyses::correction_weights(
        measured_case(measured_text(false), {{"runs.csv", table_of(scene, false)}}));
    const auto modelled = analyses::correction_weights(from_model(scene));
    expect_predicted(scene, modelled, false, 1e-8);
    for (std::size_t p = 0; p < plane_places.size(); ++p)
        EXPECT_LE(std::abs(measured.weights[p].weight - modelled.weights[p].weight),
                  1e-6 * std::abs(modelled.weights[p].weight));
    ASSERT_EQ(measured.influence.size(), modelled.influence.size());
    for (std::size_t i = 0; i < measured.influence.size(); ++i)
        EXPECT_LE(std::abs(measured.influence[i].value - modelled.influence[i].value),
                  1e-7 * std::abs(modelled.influence[i].value));
    EXPECT_FALSE(modelled.curves.empty());
}

/// Measured vibration with the model's coefficients, in both conventions.
TEST(WeightsOfACompressor, OfReadingsWithTheCoefficientsOfTheModel) {
    const model::Case scene = compressor();
    for (const bool lag : {false, true}) {
        model::Case mixed = scene;
        mixed.rotor.imbalances.clear();
        mixed.weights =
            measured_case(measured_text(lag), {{"runs.csv", table_of(scene, lag)}}).weights;
        mixed.weights->trials.clear();
        mixed.weights->runs.clear();
        std::erase_if(mixed.weights->readings, [](const auto &reading) { return reading.run > 0; });
        const auto result = analyses::correction_weights(mixed);
        EXPECT_EQ(result.source, results::InfluenceSource::model);
        expect_predicted(scene, result, lag, 1e-8);
    }
}

/// Imbalances in the planes themselves are undone to the last digit, and every choice of fewer
/// planes leaves more.
TEST(WeightsOfACompressor, UndoImbalancesInTheirOwnPlanes) {
    model::Case scene = compressor();
    scene.rotor.imbalances.clear();
    for (std::size_t p = 0; p < plane_places.size(); ++p)
        scene.rotor.imbalances.push_back(
            {"", plane_places[p], 1e-4 * static_cast<double>(p + 1), 1.3 * static_cast<double>(p)});
    const auto result = analyses::correction_weights(from_model(scene));
    for (std::size_t p = 0; p < plane_places.size(); ++p) {
        const model::Imbalance &own = scene.rotor.imbalances[p];
        EXPECT_LE(std::abs(result.weights[p].weight + std::polar(own.mr, own.phase)),
                  1e-8 * own.mr);
    }
    EXPECT_LT(result.max, 1e-8 * result.max_before);
    ASSERT_EQ(result.choices.size(), 3U);
    EXPECT_GT(result.choices[0].rms, result.choices[1].rms);
    EXPECT_GT(result.choices[1].rms, 1e3 * result.choices[2].rms);
}

/// Weights that are set already count as imbalance: with them on nothing is to be added.
TEST(WeightsOfACompressor, AreNothingWhereTheyAreSet) {
    model::Case scene = from_model(compressor());
    const auto first = analyses::correction_weights(scene);
    for (std::size_t p = 0; p < plane_places.size(); ++p)
        scene.rotor.planes[p].fixed = {first.weights[p].weight};
    const auto second = analyses::correction_weights(scene);
    for (std::size_t p = 0; p < plane_places.size(); ++p)
        EXPECT_LE(std::abs(second.weights[p].weight), 1e-8 * std::abs(first.weights[p].weight));
    EXPECT_NEAR(second.rms_before, first.rms, 1e-8 * first.rms);
}

/// A uniform shaft on springs with imbalance all along: below its second bending speed N = 1 motion
/// bends it, and with N + 2 = 3 planes, found at a slow speed and beside the first critical one,
/// next to nothing is left at the bearings over the whole range; N planes leave the rigid motions.
TEST(WeightsOfAUniformShaft, NeedTwoPlanesMoreThanItHasBendingMotions) {
    std::string text = "format = 1\n[material.s]\nE = 2.1e11\nnu = 0.3\nrho = 7800\n"
                       "[shaft]\nsegments = [{length = 1.0, outer = 0.04, elements = 4}]\n"
                       "[[bearing]]\nz = 0\nk = 1e8\nc = 5e3\n"
                       "[[bearing]]\nz = 1\nk = 1e8\nc = 5e3\n"
                       "[[probe]]\nname = \"left\"\nz = 0\n[[probe]]\nname = \"right\"\nz = 1\n"
                       "[campbell]\nmodes = 4\n";
    for (int i = 1; i <= 9; ++i)
        text += fmt::format("[[imbalance]]\nz = {}\nmr = {}\nphase = {}\n", 0.1 * i,
                            1e-5 * (1 + i % 3), 2.0 * i);
    const model::Case bare = input::load_case(written_folder(text, {}) / "case.toml");
    const results::CriticalResult critical = analyses::critical_speeds(bare, false);
    ASSERT_GE(critical.critical_speeds.size(), 3U); // backward and forward, then the next
    const double first = critical.critical_speeds[1].speed;
    const double second = critical.critical_speeds[2].speed;
    ASSERT_GT(second, 1.5 * first);
    const auto left_with = [&](const std::vector<double> &places) {
        model::Case scene = bare;
        for (std::size_t p = 0; p < places.size(); ++p) {
            model::CorrectionPlane plane;
            plane.name = fmt::format("{}", p);
            plane.z = places[p];
            scene.rotor.planes.push_back(plane);
        }
        scene.weights = model::WeightsSettings{};
        // Of the size that forces have at each: amplitudes grow with the square of the speed.
        scene.weights->speeds = {0.3 * first, 0.97 * first};
        scene.speeds = model::SpeedRange{0.1 * first, 0.5 * second, 60};
        const results::WeightsResult result = analyses::correction_weights(scene);
        double before = 0, after = 0;
        for (const results::VibrationCurve &curve : result.curves)
            for (std::size_t i = 0; i < curve.before.size(); ++i) {
                before = std::max(before, *curve.before[i]);
                after = std::max(after, *curve.after[i]);
            }
        return after / before;
    };
    EXPECT_LT(left_with({0.2, 0.5, 0.8}), 0.01);
    EXPECT_GT(left_with({0.5}), 0.02);
}

/// What has no coefficients, no speeds, no probes or nothing to balance.
TEST(WeightsOfACompressor, OfAnAsymmetricRotorAreRefused) {
    model::Case scene = from_model(compressor());
    scene.rotor.anisotropies.push_back({"", 0.9, 1e-3, 0});
    EXPECT_THROW((void)analyses::correction_weights(scene), model::AnalysisFailure);
    scene = from_model(compressor());
    scene.weights->speeds.clear();
    EXPECT_THROW((void)analyses::correction_weights(scene), model::BadInput);
    scene = from_model(compressor());
    scene.rotor.probes.clear();
    EXPECT_THROW((void)analyses::correction_weights(scene), model::BadInput);
    scene = from_model(compressor());
    scene.rotor.imbalances.clear();
    EXPECT_THROW((void)analyses::correction_weights(scene), model::BadInput);
}

// A probe in a bearing housing reads the shaft against it, one on the housing the housing.
TEST(WeightsOfAModel, ProbesInHousingsReadWhatTheResponseSays) {
    model::Case scene = input::load_case(WHIRL_ROOT "/cases/id_fan");
    const double speed = 1150 * rpm;
    scene.rotor.planes = {{"impeller", 2.1}};
    scene.weights.emplace();
    scene.weights->speeds = {speed};
    const results::WeightsResult weights = analyses::correction_weights(scene);
    scene.speeds = model::SpeedRange{speed, speed, 1};
    const std::vector<results::ResponseProbe> probes = analyses::unbalance_response(scene).probes;
    ASSERT_EQ(weights.residual.size(), probes.size());
    for (std::size_t k = 0; k < probes.size(); ++k) {
        EXPECT_EQ(weights.residual[k].probe, probes[k].name);
        EXPECT_NEAR(std::abs(weights.residual[k].before), probes[k].amplitude[0],
                    1e-6 * probes[k].amplitude[0]);
    }
}

} // namespace

} // namespace whirl::tests::modelled
