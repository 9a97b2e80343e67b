#include "report/reports.h"
#include "results/weights.h"
#include "sample_results.h"
#include "whole_report.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <complex>
#include <filesystem>
#include <limits>
#include <optional>
#include <vector>

namespace whirl::report {

namespace {

/// Two probes and planes whose names mean something elsewhere, no speed, one weight of nothing.
results::WeightsResult sample_weights() {
    results::WeightsResult result;
    result.model.none = true;
    result.model.formulation.why = "readings alone: no model of the rotor";
    result.model.notes = {"a note"};
    result.method = "minimax";
    result.lag = true;
    results::CorrectionWeight weight;
    weight.plane = "=1+1 \"it's\" <b>";
    weight.weight = std::polar(2e-4, 1.0);
    weight.on = std::polar(1e-4, 0.5);
    weight.scatter = 1e-5;
    result.weights.push_back(weight);
    result.weights.push_back({});
    results::WeightReading reading;
    reading.probe = "near, \"x\"";
    reading.before = {3e-5, 0};
    reading.after = {0, -1e-6};
    result.residual = {reading, {}};
    result.influence.push_back({"near", std::nullopt, "aft", {0.1, 0.2}});
    result.singular_values = {0.5, std::numeric_limits<double>::quiet_NaN()};
    result.dependent.push_back({{"a", "b"}, "a", 1e-6, 2e-6, 1e-3, 1e-4});
    result.choices.push_back({{"a"}, 1e-6, 2e-6, 1e-3});
    result.split.push_back({"aft", {{"aft", 3, 1.0, 0.01, 1e-4}}, 1e-4, 1e-6});
    result.rms_split = 1e-6;
    result.outliers.push_back({"near", 100.0, "t1", 7, 1e-6, 1e-5});
    return result;
}

class WeightsReport : public ScratchFolder {};

TEST_F(WeightsReport, IsWholeWithoutARotor) {
    model::Case scene;
    scene.name = "readings";
    const results::WeightsResult result = sample_weights();
    const auto json =
        expect_whole_report(write_report(describe(scene, result), folder), folder, "weights");
    EXPECT_TRUE(json.at("formulation").at("form").is_null());
    EXPECT_EQ(json.at("phase"), "lag");
    EXPECT_DOUBLE_EQ(json.at("weights")[0].at("mr").get<double>(), 2e-4);
    EXPECT_DOUBLE_EQ(json.at("weights")[0].at("total_mr").get<double>(),
                     std::abs(result.weights[0].weight + result.weights[0].on));
    EXPECT_TRUE(json.at("weights")[1].at("total_mr").is_null());
    EXPECT_TRUE(json.at("residual")[0].at("speed").is_null());
    EXPECT_TRUE(json.at("singular_values")[1].is_null());
    EXPECT_TRUE(json.at("curves").is_null());
    EXPECT_EQ(json.at("split")[0].at("pieces")[0].at("hole"), 3);
    const std::string page = content_of(folder / "report.html");
    EXPECT_EQ(page.find("<b>"), std::string::npos) << "names are escaped";
    EXPECT_EQ(page.find("Side view of the rotor"), std::string::npos) << "there is none";
    const std::string csv = content_of(folder / "weights.csv");
    EXPECT_NE(csv.find("\"'=1+1"), std::string::npos) << "no formula: " << csv;
    const std::string text = to_text(describe(scene, result));
    EXPECT_EQ(text.find("nan"), std::string::npos) << text;
    EXPECT_NE(text.find("against the spin"), std::string::npos);
}

// Places of all kinds, one that does not move, and a speed without a motion.
TEST_F(WeightsReport, HasTheInfluenceOverSpeed) {
    model::Case scene;
    scene.name = "modelled";
    results::WeightsResult result = sample_weights();
    result.curve_speeds = {0, 100, 200};
    result.curves = {{"near", {0.0, 1e-6, std::nullopt}, {0.0, 1e-7, std::nullopt}}};
    using Values = std::vector<std::optional<std::complex<double>>>;
    const Values moving{0.0, std::polar(0.02, -2.0), std::nullopt};
    result.influence_curves = {{"probe", "near, \"x\"", 0.1, 0.7, "aft", moving},
                               {"bearing", "=1+1", 0, 0, "aft", moving},
                               {"bearing", "=1+1", 0, 1.5, "aft", moving},
                               {"force", "=1+1", 0, 0, "aft", {std::nullopt, 0.5, std::nullopt}},
                               {"station", "", 0.4, 0, "aft", moving},
                               {"probe", "near, \"x\"", 0.1, 0.7, "<b>", {0.0, 0.0, 0.0}}};
    result.procedure.emplace();
    result.procedure->procedures = {"B", "G"};
    result.procedure->why = {"it bends at {}", model::as::speed(100)};
    result.procedure->planes = {"three are needed"};
    const auto json =
        expect_whole_report(write_report(describe(scene, result), folder), folder, "weights");
    const auto &over_speed = json.at("influence_over_speed");
    EXPECT_EQ(over_speed.at("speeds").size(), 3U);
    const auto &places = over_speed.at("places");
    ASSERT_EQ(places.size(), 6U);
    EXPECT_DOUBLE_EQ(places[0].at("amplitude")[1].get<double>(), 0.02);
    EXPECT_DOUBLE_EQ(places[0].at("phase")[1].get<double>(), -2);
    EXPECT_TRUE(places[0].at("phase")[0].is_null()) << "nothing has no phase";
    EXPECT_TRUE(places[0].at("amplitude")[2].is_null());
    EXPECT_TRUE(places[0].at("force").is_null());
    EXPECT_DOUBLE_EQ(places[3].at("force")[1].get<double>(), 0.5);
    EXPECT_TRUE(places[3].at("amplitude").is_null());
    EXPECT_EQ(json.at("procedure").at("procedures").size(), 2U);
    const std::string csv = content_of(folder / "weights_influence.csv");
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 6 * 3);
    EXPECT_TRUE(std::filesystem::exists(folder / "influence.svg"));
    const std::string text = to_text(describe(scene, result));
    EXPECT_NE(text.find("procedure B (two-plane balancing) or G (multiple speed balancing): it "
                        "bends at 954.93 rpm."),
              std::string::npos)
        << text;
}

} // namespace

} // namespace whirl::report
