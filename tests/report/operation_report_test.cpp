#include "report/pictures/operation.h"
#include "results/critical.h"
#include "results/response.h"
#include "results/stability.h"
#include "sample_results.h"
#include "whole_report.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <limits>

namespace whirl::report {

namespace {

model::Case running_case() {
    model::Case scene = sample_case();
    scene.operation = model::Operation{100, 200, 220};
    return scene;
}

results::CriticalResult sample_critical() {
    results::CriticalResult result;
    result.critical_speeds.resize(2);
    result.critical_speeds[0].speed = 90;
    result.critical_speeds[0].damping.amplification = 4;
    result.critical_speeds[1].speed = 150;
    result.critical_speeds[1].damping.amplification = 2;
    results::SeparationMargin margin;
    margin.speed = 90;
    margin.whirl = results::Whirl::forward;
    margin.amplification = 4;
    margin.source = "damping";
    margin.side = results::MarginSide::below;
    margin.found = 10;
    margin.required = 10.2;
    result.margins = {margin};
    return result;
}

/// Two runs, one of which rests at a resonance without damping.
results::ResponseResult sample_runs() {
    results::ResponseResult result;
    result.speeds = {100, 200};
    result.operating.emplace();
    for (const char *name : {"first bending", "overhung left"}) {
        results::StandardRun &run = result.runs.emplace_back();
        run.name = name;
        run.fit = model::BearingFit::least;
        run.placed_by = {150};
        run.unbalance = {{"", 0.5, 2e-5, 0}, {"", 0.75, 1e-5, 1}};
        results::OperatingRow row;
        row.of = "probe";
        row.name = "DE";
        row.speed = 100;
        row.at = "minimum";
        row.amplitude = result.runs.size() == 1 ? 3e-6 : std::numeric_limits<double>::infinity();
        row.phase = std::numeric_limits<double>::quiet_NaN();
        run.operating.rows = {row, row};
    }
    result.worst_run = 1;
    result.worst_run_text = {"run overhung left"};
    return result;
}

} // namespace

TEST(OperationBand, IsCutAtTheAxis) {
    const model::Case scene = running_case();
    const double all = usual(Quantity::speed, 1000);
    EXPECT_NE(operation_band(scene, usual, {0, all})
                  .find(fmt::format("first {:.9g},graph 0 to first "
                                    "{:.9g},graph 1 behind",
                                    usual(Quantity::speed, 100), usual(Quantity::speed, 200))),
              std::string::npos);
    EXPECT_NE(operation_band(scene, usual, {0, usual(Quantity::speed, 150)})
                  .find(fmt::format("to first {:.9g},", usual(Quantity::speed, 150))),
              std::string::npos);
    EXPECT_EQ(operation_band(scene, usual, {0, usual(Quantity::speed, 90)}), "");
    EXPECT_EQ(operation_key(scene, usual, {0, usual(Quantity::speed, 90)}), "");
    EXPECT_EQ(operation_band(model::Case{}, usual, {0, all}), "");
    EXPECT_NE(operation_key(scene, usual, {0, all}).find("'trip'"), std::string::npos);
    EXPECT_EQ(operation_key(scene, usual, {0, usual(Quantity::speed, 210)}).find("'trip'"),
              std::string::npos);
    EXPECT_NE(operation_band(scene, usual, {0, all}, SpeedAxis::y).find("graph 0,first"),
              std::string::npos);
}

TEST(OperationBand, HasEdgesForWhatLiesOverIt) {
    const model::Case scene = running_case();
    const auto edges = [](const model::Case &of, double fastest, bool upright) {
        ChartPanel panel{100, along_speeds(usual, {0, fastest}), {.low = 0, .high = 1}};
        if (!upright)
            std::swap(panel.x, panel.y);
        add_operation(of, usual, {"edge", "#000000"}, panel);
        std::vector<double> places;
        for (const ChartCurve &line : panel.curves)
            if (line.name == "edge")
                places.push_back(upright ? line.points.front().x : *line.points.front().y);
        return places;
    };
    const std::vector<double> both{usual(Quantity::speed, 100), usual(Quantity::speed, 200)};
    EXPECT_EQ(edges(scene, 1000, true), both);
    EXPECT_EQ(edges(scene, 1000, false), both);
    EXPECT_TRUE(edges(scene, 90, true).empty());
    EXPECT_TRUE(edges(model::Case{}, 1000, true).empty());
}

class OperationReport : public ScratchFolder {};

TEST_F(OperationReport, MarginsAreInTextPageAndData) {
    const model::Case scene = running_case();
    const results::CriticalResult result = sample_critical();
    const Files files = write_report(scene, result, folder);
    const nlohmann::json json = expect_whole_report(files, folder, "critical");
    EXPECT_EQ(json.at("operation").at("from"), 100);
    EXPECT_EQ(json.at("operation").at("trip"), 220);
    ASSERT_EQ(json.at("margins").size(), 1U);
    const nlohmann::json &margin = json.at("margins")[0];
    EXPECT_EQ(margin.at("side"), "below");
    EXPECT_EQ(margin.at("required"), 10.2);
    EXPECT_EQ(margin.at("passes"), false);
    EXPECT_TRUE(margin.at("z").is_null());
    const std::string text = describe(scene, result).text({});
    EXPECT_NE(text.find("Separation margins"), std::string::npos);
    EXPECT_NE(text.find("fails"), std::string::npos);
    EXPECT_NE(content_of(folder / "report.html").find("Margin required"), std::string::npos);
}

/// A margin that is wide enough is never called too small: it fails for another reason.
TEST_F(OperationReport, TheAnswerSaysWhyMarginsFail) {
    const model::Case scene = running_case();
    results::CriticalResult result = sample_critical();
    const auto answer = [&] { return describe(scene, result).answer.text(); };
    EXPECT_NE(answer().find("; 1 of 1 separation margins is too small"), std::string::npos);
    results::SeparationMargin wide = result.margins->front();
    wide.found = 40;
    wide.grows = true;
    result.margins->push_back(wide);
    EXPECT_NE(answer().find("; 1 of 2 separation margins is too small, 1 of 2 is of a motion that "
                            "grows"),
              std::string::npos)
        << answer();
    result.margins->front() = wide;
    EXPECT_NE(answer().find("; 2 of 2 separation margins are of motions that grow"),
              std::string::npos)
        << answer();
    wide.grows = false; // above the range, below the trip speed
    result.margins = {wide};
    EXPECT_NE(answer().find("is at a speed reached before the trip"), std::string::npos)
        << answer();
    result.margins->front().passes = true;
    EXPECT_NE(answer().find("each has the separation margin"), std::string::npos);
}

TEST_F(OperationReport, WithoutOperatingSpeedsThereAreNone) {
    results::CriticalResult result = sample_critical();
    result.margins.reset();
    const model::Case scene = sample_case();
    const Files files = write_report(scene, result, folder);
    const nlohmann::json json = expect_whole_report(files, folder, "critical");
    EXPECT_FALSE(json.contains("margins"));
    EXPECT_FALSE(json.contains("operation"));
    EXPECT_EQ(describe(scene, result).text({}).find("Separation"), std::string::npos);
}

/// A motion that no longer swings leaves a gap, and no root is null.
TEST_F(OperationReport, StandardRunsStandSideBySide) {
    const model::Case scene = running_case();
    const results::ResponseResult result = sample_runs();
    const Report report = describe(scene, result);
    const auto json = nlohmann::json::parse(to_json(report));
    ASSERT_EQ(json.at("runs").size(), 2U);
    const auto &run = json.at("runs").at(0);
    EXPECT_EQ(run.at("name"), "first bending");
    EXPECT_EQ(run.at("clearance"), "min");
    EXPECT_EQ(run.at("unbalance").at(1).at("mr"), 1e-5);
    EXPECT_EQ(run.at("unbalance").at(1).at("phase"), 1);
    EXPECT_EQ(run.at("operating").at(1).at("amplitude"), 3e-6);
    EXPECT_TRUE(json.at("runs").at(1).at("operating").at(0).at("amplitude").is_null());
    EXPECT_EQ(json.at("worst_run").at("index"), 1);
    const std::string text = to_text(report);
    EXPECT_NE(text.find("The worst of 2 standard runs is run overhung left."), std::string::npos);
    EXPECT_EQ(text.find("nan"), std::string::npos);
    EXPECT_EQ(text.find("inf"), std::string::npos);
    // A line a run and place.
    const auto tables = report.tables();
    ASSERT_EQ(tables.size(), 2U);
    EXPECT_EQ(tables[1].name, "response_runs");
    const std::string csv = tables[1].csv(Units());
    EXPECT_TRUE(csv.starts_with("run,clearance,speed"));
    EXPECT_EQ(std::ranges::count(csv, '\n'), 5);
    EXPECT_NE(csv.find("\noverhung left,min,100"), std::string::npos);
    // None: no such keys.
    results::ResponseResult without = result;
    without.runs.clear();
    const auto plain = nlohmann::json::parse(to_json(describe(scene, without)));
    EXPECT_FALSE(plain.contains("runs"));
    EXPECT_FALSE(plain.contains("worst_run"));
}

TEST_F(OperationReport, AddedCouplingWithoutARoot) {
    results::StabilityResult result;
    result.speeds = {0, 100};
    result.growth = {-1, -1};
    result.verdict = {results::Verdict::stable, results::Verdict::stable};
    results::Level1 &level1 = result.level1.emplace();
    level1.speed = 200;
    level1.q = {0, 1e6};
    level1.log_dec = {0.3, std::numeric_limits<double>::quiet_NaN()};
    level1.frequency = level1.log_dec;
    level1.no_critical = "a motion grows without";
    level1.anticipated = 1e5;
    level1.stages = {{"impeller", false, 1e6, 200, 0.4, 0.01, 1.2, 1e5}};
    level1.checks = {{"decrement", 0.05, 0.1, false, {}}, {"ratio", {}, 2, {}, "nobody knows"}};
    level1.level_two = true;
    level1.verdict = {"level II required: decrement {}", results::as::number(0.05)};
    const model::Case scene = running_case();
    const Files files = write_report(scene, result, folder);
    const nlohmann::json json = expect_whole_report(files, folder, "stability");
    EXPECT_TRUE(json.at("level1").at("critical_cross_coupling").is_null());
    EXPECT_TRUE(json.at("level1").at("log_dec")[1].is_null());
    EXPECT_EQ(json.at("level1").at("no_critical"), "a motion grows without");
    EXPECT_EQ(json.at("level1").at("level_two"), true);
    EXPECT_EQ(json.at("level1").at("checks")[0].at("passes"), false);
    EXPECT_TRUE(json.at("level1").at("checks")[1].at("passes").is_null());
    EXPECT_EQ(json.at("level1").at("stages")[0].at("cross_coupling"), 1e5);
    const std::string text = describe(scene, result).text({});
    EXPECT_EQ(text.find("nan"), std::string::npos);
    for (const std::string &reader : {text, content_of(folder / "report.html")})
        for (const char *words : {"level II required: decrement 0.05", "not judged", "nobody knows",
                                  "impeller", "a motion grows without"})
            EXPECT_NE(reader.find(words), std::string::npos) << words;
    EXPECT_TRUE(std::filesystem::exists(folder / "level1.csv"));
}

} // namespace whirl::report
