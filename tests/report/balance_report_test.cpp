// Report of the command balance.

#include "results/balance.h"
#include "sample_results.h"
#include "whole_report.h"

#include <nlohmann/json.hpp>
#include <pugixml.hpp>

#include <algorithm>
#include <limits>

namespace whirl::report {

namespace {

/// Two planes at three speeds, with names that could break a script.
results::BalanceResult sample_balance() {
    results::BalanceResult result;
    result.speeds = {0, 100, 200};
    result.critical_speeds = {50};
    for (const double z : {0.3, 1.2}) {
        results::BalancePlane plane;
        plane.name = wicked_title;
        plane.z = z;
        plane.bands.bands = {{50, 120}, {150, 200}};
        plane.bands.rigid_bands = std::vector<results::Interval>{{51, 125}};
        plane.bands.pinned = {120};
        plane.bands.ends = {{120, true, 125, -0.04, {}, 120, {}}, {150, false, {}, {}, {}, {}, {}}};
        plane.criterion = {0, -0.1, std::numeric_limits<double>::infinity()};
        result.planes.push_back(plane);
    }
    result.joint.rank = 2;
    for (const double speed : result.speeds)
        result.joint.signature.push_back({speed, {-0.2, 1e-6}, 1, 5e-6, {{1, 0}, {0.1, -0.2}}});
    result.findings = {"a <finding>"};
    return result;
}

results::BalanceResult full_balance() {
    results::BalanceResult result = sample_balance();
    results::Placement map;
    map.z = map.pair_z = {0, 0.75, 1.5};
    map.speeds = {0, 100, 200};
    map.criterion = map.pair_value = {{0, 0.1, -0.1}, {1, -1, 1}, {-5, 1e9, -0.2}};
    map.share = {0.1, 0.9, 0.2};
    map.pair_speed = 200;
    map.best = {{0.75}, 0.9, 0.5};
    map.best_pair = {{0, 1.5}, 0.4, 0.1};
    result.placement = map;
    results::PendulumBalance pendulum;
    pendulum.rho = 2;
    pendulum.threshold = 0.7;
    pendulum.limit = 1.0 / 3;
    pendulum.omega_0 = 150;
    pendulum.speeds = result.speeds;
    pendulum.approximate = {1, std::numeric_limits<double>::infinity(), 0.4};
    pendulum.planar = {std::nullopt, 2, 0.5};
    pendulum.states = {{}, {{2, 0.1, 0.2, -1, true, false}, {3, 1, 1, 5, false, true}}, {}};
    for (const double H : {0.0, 0.3}) {
        pendulum.dampings.push_back({0.18,
                                     0.02,
                                     2,
                                     H,
                                     {0.5, 1, 2},
                                     {1.5, std::numeric_limits<double>::infinity(), 0.4},
                                     {1.5, std::nullopt, 0.41},
                                     {true, false, true}});
        pendulum.designs.push_back(pendulum.dampings.back());
    }
    result.pendulum = {pendulum};
    result.balanced_position =
        results::BalancedPosition{{{60, 110}}, {{1e-9, 2e-9}}, 3, {{70, 100}}, {{55, 120}}};
    result.first_order = results::FirstOrder{{{58, 115}}, {{1e-9, {}}}, {{}, 0.5, 0.0}};
    result.simulated = {{80, "balanced", 0.01, -0.5}, {160, "lagging", {}, {}}};
    return result;
}

class BalanceReport : public ScratchFolder {};

} // namespace

TEST_F(BalanceReport, JsonHasTheAgreedKeys) {
    const auto json = nlohmann::json::parse(to_json(sample_case(), full_balance()));
    EXPECT_EQ(json.at("command"), "balance");
    EXPECT_EQ(json.at("planes").at(1).at("bands"),
              (std::vector<std::vector<double>>{{50, 120}, {150, 200}}));
    EXPECT_EQ(json.at("planes").at(0).at("rigid_bands").at(0).at(1), 125);
    EXPECT_TRUE(json.at("planes").at(0).at("criterion").at(2).is_null()); // infinity
    EXPECT_TRUE(json.at("joint").at("rigid_bands").is_null());
    EXPECT_EQ(json.at("joint").at("signature").at(2).at("speed"), 200);
    EXPECT_EQ(json.at("joint").at("signature").at(2).at("eigenvalues"),
              (std::vector<double>{-0.2, 1e-6}));
    EXPECT_TRUE(nlohmann::json::parse(to_json(sample_case(), sample_balance()))
                    .at("balanced_position")
                    .is_null());
    EXPECT_EQ(json.at("first_order").at("bands").at(0), (std::vector<double>{58, 115}));
    EXPECT_EQ(json.at("first_order").at("least_drag"), nlohmann::json::parse("[null, 0.5, 0.0]"));
    EXPECT_EQ(json.at("simulated").at(0).at("growth"), -0.5);
    EXPECT_TRUE(json.at("simulated").at(1).at("residual_ratio").is_null());
    EXPECT_EQ(json.at("pendulum").at(0).at("designs").at(1).at("exact"),
              nlohmann::json::parse("[1.5, null, 0.41]"));
    EXPECT_EQ(json.at("placement").at("pairs").at("best").at("z"), (std::vector<double>{0, 1.5}));
    const auto &pendulum = json.at("pendulum").at(0);
    EXPECT_EQ(pendulum.at("threshold"), 0.7);
    const auto &efficiency = pendulum.at("efficiency");
    EXPECT_EQ(efficiency.at("exact"), nlohmann::json::parse("[null, 2.0, null]"));
    EXPECT_EQ(efficiency.at("approximate"), nlohmann::json::parse("[1.0, null, 0.4]"));
    EXPECT_EQ(efficiency.at("stable"), nlohmann::json::parse("[null, true, null]"));
    EXPECT_FALSE(
        nlohmann::json::parse(to_json(sample_case(), sample_balance())).contains("placement"));
    results::BalanceResult stable = sample_balance();
    stable.balanced_position =
        results::BalancedPosition{std::vector<results::Interval>{{60, 110}}, {}, 1, {}, {}};
    EXPECT_EQ(
        nlohmann::json::parse(to_json(sample_case(), stable))["balanced_position"]["bands"][0][1],
        110);
}

TEST_F(BalanceReport, EveryCsvRowHasAsManyCellsAsTheHeader) {
    const std::string csv = to_csv(full_balance());
    std::istringstream stream(csv);
    int rows = 0;
    for (std::string line; std::getline(stream, line); ++rows)
        EXPECT_EQ(std::count(line.begin(), line.end(), ','), 7) << line;
    // Header; per plane 2 bands and a rigid one; 3 x 2 eigenvalues; 2 x 3 criteria; 2 motions with
    // pendulums; at first order a band, its errors and a drag at two speeds; a band of the balanced
    // position; 2 motions in time.
    EXPECT_EQ(rows, 1 + 2 * 3 + 6 + 6 + 2 + 4 + 1 + 2);
}

TEST_F(BalanceReport, WritesAllPicturesAndAPage) {
    const Files files = write_report(sample_case(), full_balance(), folder);
    const std::string page = content_of(folder / "report.html");
    EXPECT_NE(page.find("a &lt;finding&gt;"), std::string::npos);
    if (!files.notes.empty())
        GTEST_SKIP() << files.notes[0];
    for (const char *name : {"balance", "placement", "pendulum", "pendulum_designs"}) {
        pugi::xml_document svg;
        EXPECT_TRUE(svg.load_file((folder / (std::string(name) + ".svg")).c_str())) << name;
        EXPECT_EQ(content_of(folder / (std::string(name) + ".png")).substr(1, 3), "PNG") << name;
    }
    EXPECT_NE(page.find("<svg"), std::string::npos);
}

TEST_F(BalanceReport, EmptyAndSingleSpeedResultsStillMakeAReport) {
    const Files nothing = write_report(model::Case{}, results::BalanceResult{}, folder / "a");
    const auto empty = expect_whole_report(nothing, folder / "a", "balance");
    EXPECT_EQ(empty.at("planes"), nlohmann::json::array());
    EXPECT_EQ(empty.at("speeds"), nlohmann::json::array());
    EXPECT_EQ(lines_of(content_of(folder / "a/balance.csv")).size(), 1U) << "the header alone";
    results::BalanceResult one = sample_balance();
    one.speeds.resize(1);
    one.joint.signature.resize(1);
    for (auto &plane : one.planes) {
        plane.bands = {};
        plane.criterion.resize(1);
    }
    const Files single = write_report(sample_case(), one, folder / "b");
    const auto json = expect_whole_report(single, folder / "b", "balance");
    ASSERT_EQ(json.at("planes").size(), 2U);
    for (const auto &plane : json.at("planes")) {
        EXPECT_EQ(plane.at("name"), wicked_title);
        EXPECT_EQ(plane.at("bands"), nlohmann::json::array());
        EXPECT_EQ(plane.at("criterion").dump(), "[0.0]");
    }
    EXPECT_EQ(json.at("joint").at("signature").size(), 1U);
}

} // namespace whirl::report
