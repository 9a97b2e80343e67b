#include "results/samples.h"
#include "sample_results.h"
#include "whole_report.h"

#include <nlohmann/json.hpp>

namespace whirl::report {

namespace {

/// Four samples of which one failed; an answer that one of them lacks.
results::SamplesResult four_samples() {
    results::SamplesResult result;
    result.model.notes = {"a note"};
    result.count = 4;
    result.failed = 1;
    result.seed = 7;
    result.inputs = {{"bearing[0].k", "N/m", "normal", {1, 2, 3, -4}}};
    results::SampledAnswer speed;
    speed.of = "critical";
    speed.name = "forward <1>";
    speed.unit = "rad/s";
    speed.nominal = 100;
    speed.nominal_error = 1e-12;
    speed.values = {90., 110., 100., std::nullopt};
    speed.quantiles = {{0.5, 100, 90., std::nullopt}};
    speed.mean = 100;
    speed.deviation = 10;
    speed.present = 3;
    results::SampledAnswer force;
    force.of = "peaks";
    force.name = "bearing left, peak 1, value";
    force.unit = "N";
    force.values = {5., std::nullopt, 5., std::nullopt};
    force.quantiles = {{0.5, 5, std::nullopt, std::nullopt}};
    force.present = 2;
    result.answers = {speed, force};
    result.failures = {{"bearing[0].k: expected a stiffness", {3}}};
    return result;
}

} // namespace

class SamplesReport : public ScratchFolder {};

TEST_F(SamplesReport, JsonHasWhatWasDrawnAndAnswered) {
    const auto json = nlohmann::json::parse(to_json(sample_case(), four_samples()));
    EXPECT_EQ(json.at("command"), "samples");
    EXPECT_EQ(json.at("samples").at("count"), 4);
    EXPECT_EQ(json.at("samples").at("failed"), 1);
    EXPECT_EQ(json.at("samples").at("seed"), 7);
    EXPECT_EQ(json.at("samples").at("failures").at(0).at("samples").dump(), "[3]");
    EXPECT_EQ(json.at("inputs").at(0).at("values").size(), 4U);
    EXPECT_EQ(json.at("inputs").at(0).at("distribution"), "normal");
    const auto &speed = json.at("answers").at(0);
    EXPECT_EQ(speed.at("of"), "critical");
    EXPECT_EQ(speed.at("name"), "forward <1>");
    EXPECT_EQ(speed.at("values").dump(), "[90.0,110.0,100.0,null]");
    EXPECT_EQ(speed.at("quantiles").dump(),
              "[{\"interval\":[90.0,null],\"p\":0.5,\"value\":100.0}]");
    EXPECT_TRUE(json.at("answers").at(1).at("mean").is_null());
}

TEST_F(SamplesReport, CsvHasALineASampleWithItsFailure) {
    const auto lines = lines_of(to_csv(four_samples()));
    ASSERT_EQ(lines.size(), 5U);
    EXPECT_EQ(lines[0], "sample,bearing[0].k [N/m],critical forward <1> [rad/s],\"bearing left, "
                        "peak 1, value [N]\",failure");
    EXPECT_EQ(lines[2], "1,2,110,,");
    EXPECT_EQ(lines[4], "3,-4,,,bearing[0].k: expected a stiffness");
}

TEST_F(SamplesReport, TextHasQuantilesAndReasons) {
    const results::SamplesResult result = four_samples();
    const model::Case scene = sample_case();
    const std::string text = describe(scene, result).text({});
    for (const char *part : {"4 samples, seed 7", "50 %", "954.93", "bearing[0].k: expected"})
        EXPECT_NE(text.find(part), std::string::npos) << part << " in\n" << text;
}

TEST_F(SamplesReport, WritesPictureDataAndPage) {
    const Files files = write_report(sample_case(), four_samples(), folder);
    const auto json = expect_whole_report(files, folder, "samples");
    EXPECT_EQ(json.at("answers").size(), 2U);
    const std::string page = content_of(folder / "report.html");
    EXPECT_NE(page.find("forward &lt;1&gt;"), std::string::npos);
    EXPECT_EQ(page.find("forward <1>"), std::string::npos);
    const Files nothing = write_report(model::Case{}, results::SamplesResult{}, folder / "empty");
    EXPECT_EQ(expect_whole_report(nothing, folder / "empty", "samples").at("answers"),
              nlohmann::json::array());
}

} // namespace whirl::report
