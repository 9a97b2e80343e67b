#include "model/errors.h"
#include "report/common/text_width.h"
#include "report/pictures/figures.h"
#include "results/accuracy.h"
#include "results/campbell.h"
#include "results/critical.h"
#include "results/modes.h"
#include "results/response.h"
#include "results/show.h"
#include "sample_results.h"
#include "whole_report.h"

#include <nlohmann/json.hpp>
#include <pugixml.hpp>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <numbers>

namespace whirl::report {

namespace fs = std::filesystem;
using namespace nlohmann::literals;

class ReportTest : public ScratchFolder {
  protected:
    /// Every file announced is there with content, and nothing else is.
    void expect_complete(const Files &files) const {
        for (const fs::path &path : files.paths)
            EXPECT_GT(fs::file_size(path), 50u) << path;
        EXPECT_EQ(static_cast<std::size_t>(
                      std::distance(fs::directory_iterator(folder), fs::directory_iterator())),
                  files.paths.size());
    }
};

TEST_F(ReportTest, CampbellWritesPicturesDataAndPage) {
    const Files files = write_report(sample_case(), sample_campbell(), folder);
    expect_complete(files);
    EXPECT_TRUE(nlohmann::json::accept(content_of(folder / "campbell.json")));
    EXPECT_TRUE(fs::exists(folder / "report.html"));
    if (!files.notes.empty())
        GTEST_SKIP() << files.notes[0];
    EXPECT_EQ(files.paths.at(0), folder / "campbell.svg");
    EXPECT_EQ(content_of(folder / "campbell.png").substr(1, 3), "PNG");
    pugi::xml_document svg;
    EXPECT_TRUE(svg.load_file((folder / "campbell.svg").c_str()));
}

TEST_F(ReportTest, EmptyResultsStillMakeAReport) {
    // An empty list in the data, and of the table the header alone.
    const auto expect_empty = [&](const auto &result, const std::string &command,
                                  const std::string &list, std::size_t lines) {
        const fs::path at = folder / command;
        const Files files = write_report(model::Case{}, result, at);
        const nlohmann::json json = expect_whole_report(files, at, command);
        EXPECT_EQ(json.value(list, nlohmann::json("no such list")), nlohmann::json::array())
            << command;
        const std::vector<std::string> table = lines_of(content_of(at / (command + ".csv")));
        ASSERT_EQ(table.size(), lines) << command;
        EXPECT_NE(table[0].find(" ["), std::string::npos) << "units: " << table[0];
    };
    expect_empty(results::CampbellResult{}, "campbell", "modes", 1);
    expect_empty(results::CriticalResult{}, "critical", "critical_speeds", 1);
    expect_empty(results::ResponseResult{}, "response", "nodes", 1);
    expect_empty(results::ModesResult{}, "modes", "modes", 1);
    expect_empty(results::ShowResult{}, "show", "balancers", 2); // with the rotor's own numbers
    expect_empty(results::AccuracyResult{}, "accuracy", "rows", 1);
}

/// Alone the motion under the weight is the response; beside imbalances it has files of its own.
TEST_F(ReportTest, MotionUnderTheWeight) {
    results::ResponseResult result;
    result.speeds = {100};
    result.gravity.emplace().gravity = 9.81;
    result.gravity->stations.push_back(
        {0.5, "disc", {3e-5}, {1e-6}, {-3e-5}, {1e-6}, {0.3}, {1e-9}, {1e-11}});
    result.gravity->bearings.push_back({0, "left", {44}, {2.5}, {1e-8}, {1e-10}});
    Files files = write_report(sample_case(), result, folder / "alone");
    (void)expect_whole_report(files, folder / "alone", "response");
    const auto alone = lines_of(content_of(folder / "alone" / "response.csv"));
    ASSERT_EQ(alone.size(), 3U);
    EXPECT_EQ(alone[1], "100,station,disc,0.5,3e-05,1e-06,-3e-05,1e-06,0.3,,,1e-09,1e-11");
    EXPECT_EQ(alone[2], "100,bearing,left,0,,,,,,44,2.5,1e-08,1e-10");
    result.nodes.emplace_back().amplitude = {1e-5};
    files = write_report(sample_case(), result, folder / "beside");
    (void)expect_whole_report(files, folder / "beside", "response");
    EXPECT_EQ(lines_of(content_of(folder / "beside" / "response.csv")).size(), 2U);
    EXPECT_EQ(content_of(folder / "beside" / "response_gravity.csv"),
              content_of(folder / "alone" / "response.csv"));
}

TEST_F(ReportTest, SingleSpeedStillMakesAReport) {
    results::CampbellResult result = sample_campbell();
    result.speeds.resize(1);
    for (results::CampbellMode &mode : result.modes)
        mode.frequency.resize(1);
    const Files files = write_report(sample_case(), result, folder);
    const nlohmann::json json = expect_whole_report(files, folder, "campbell");
    EXPECT_EQ(json.at("speeds").dump(), "[0.0]");
    EXPECT_EQ(json.at("/modes/0/frequency"_json_pointer).dump(), "[85.389371234123]");
    EXPECT_EQ(json.at("/modes/1/frequency"_json_pointer).dump(), "[90.0]");
    const std::vector<std::string> table = lines_of(content_of(folder / "campbell.csv"));
    ASSERT_EQ(table.size(), 3U);
    EXPECT_EQ(table[1].rfind("0,1B,85.389371234123,", 0), 0U) << table[1];
    EXPECT_EQ(table[2].rfind("0,1F,90,", 0), 0U) << table[2];
}

TEST_F(ReportTest, LinesWithoutAFrequencyStandLastInTheTextOrNotAtAll) {
    results::CampbellResult result = sample_campbell();
    result.modes[0].frequency.back().reset();
    result.modes[0].absent.back() = "overdamped";
    result.modes.push_back(result.modes[0]);
    result.modes.back().label = "7M";
    result.modes.back().absent.back() = "not followed";
    const model::Case scene = sample_case();
    const std::string text = describe(scene, result).text({});
    EXPECT_LT(text.find("\n  1F "), text.find("\n  1B "));
    EXPECT_NE(text.find("\n  1B "), std::string::npos);
    EXPECT_EQ(text.find("7M"), std::string::npos) << text;
}

TEST_F(ReportTest, ModesHaveAFileForParaView) {
    expect_complete(write_report(sample_case(), sample_modes(), folder));
    EXPECT_TRUE(fs::exists(folder / "modes.vtp"));
}

/// A balancer with curves of three points; numbers of no rotor in particular.
results::BalancerNumbers sample_balancer() {
    results::BalancerNumbers balancer;
    balancer.name = "it's <one> & \"two\"";
    balancer.E = 2;
    balancer.D = {-0.5, 0.1};
    balancer.D_interval = {0.25, 0.75};
    balancer.dimensionless.m = 0.05;
    results::CompositeCurves &curves = balancer.curves.emplace();
    curves.m = {0, 0.1, 0.2};
    curves.angle = {0, 2, 4};
    for (auto *list :
         {&curves.A_m, &curves.C, &curves.A_C1, &curves.A_C2, &curves.A_C1_paper,
          &curves.A_C2_paper, &curves.A, &curves.A_paper, &curves.A_without, &curves.A_full,
          &curves.A_least, &curves.A_largest, &curves.A_C, &curves.A_C_paper})
        *list = {0.5, 0.6, 0.7};
    return balancer;
}

TEST_F(ReportTest, ShowDrawsBalancersAndAnisotropy) {
    results::ShowResult result;
    results::BalancerNumbers idle = sample_balancer(); // no imbalance: E is infinite
    idle.E = std::numeric_limits<double>::infinity();
    results::BalancerNumbers weak; // no balanced position: no curves
    weak.E = 0.5;
    result.balancers = {sample_balancer(), weak, idle};
    results::AnisotropyChart &chart = result.anisotropy.emplace();
    chart.speed = {1, 2};
    chart.limit = {0.1, 0.2};
    chart.undamped = {0, 0.1};
    chart.polar = {0.5, 1};
    chart.critical_over_polar = {{1.0, 1.5}, {}};
    chart.unstable_over_polar = {results::ChartBand{1.1, std::nullopt}, std::nullopt};
    const Files files = write_report(sample_case(), result, folder);
    expect_complete(files);
    const auto json = nlohmann::json::parse(content_of(folder / "show.json"));
    EXPECT_EQ(json.at("balancers").size(), 3U);
    EXPECT_EQ(json.at("/balancers/0/D_s"_json_pointer), 0.1);
    EXPECT_EQ(json.at("/balancers/0/D_interval/1"_json_pointer), 0.75);
    EXPECT_TRUE(json.at("/balancers/1/D_c"_json_pointer).is_null());
    EXPECT_TRUE(json.at("/balancers/2/E"_json_pointer).is_null());
    EXPECT_TRUE(json.at("/balancers/0/dimensionless/p2"_json_pointer).is_null());
    const std::string page = content_of(folder / "report.html");
    EXPECT_NE(page.find("it's &lt;one&gt;"), std::string::npos) << "escaped";
    if (!files.notes.empty())
        GTEST_SKIP() << files.notes[0];
    for (const char *name : {"composite.svg", "composite_3.svg", "anisotropy.svg"}) {
        pugi::xml_document svg;
        EXPECT_TRUE(svg.load_file((folder / name).c_str())) << name;
        EXPECT_TRUE(fs::exists((folder / name).replace_extension(".png"))) << name;
        EXPECT_TRUE(fs::exists((folder / name).replace_extension(".csv"))) << name;
    }
    EXPECT_FALSE(fs::exists(folder / "composite_2.svg"));
}

TEST_F(ReportTest, WithoutGnuplotTheRestIsWrittenAndANoteSaysSo) {
    const char *found = std::getenv("PATH");
    const std::string path = found == nullptr ? "" : found;
    setenv("PATH", "/nonexistent", 1);
    const Files files = write_report(sample_case(), sample_campbell(), folder);
    setenv("PATH", path.c_str(), 1);
    expect_complete(files);
    ASSERT_EQ(files.notes.size(), 1u);
    EXPECT_NE(files.notes[0].find("gnuplot"), std::string::npos);
    EXPECT_FALSE(fs::exists(folder / "campbell.svg"));
    EXPECT_TRUE(fs::exists(folder / "campbell.json"));
}

// Each imbalance is in the drawing, on its side, with its size; one of zero is not.
TEST(SceneDrawing, ShowsImbalances) {
    model::Case scene;
    model::Segment segment;
    segment.length = 1;
    segment.outer_start = segment.outer_end = 0.05;
    scene.rotor.shaft.segments = {segment};
    scene.rotor.imbalances = {
        {"", 0.25, 12e-6, 0}, {"blade", 0.5, 2e-3, std::numbers::pi}, {"", 0.75, 0, 0}};
    const Drawing drawing = show_drawing(scene, results::ShowResult{}, Units::of_readers({}));
    const auto text = [&](const std::string &wanted) {
        return std::count_if(drawing.texts.begin(), drawing.texts.end(),
                             [&](const auto &t) { return t.text == wanted; });
    };
    EXPECT_EQ(text("imbalance 1: 12 g mm"), 1);
    EXPECT_EQ(text("blade: 2000 g mm"), 1);
    EXPECT_EQ(text("imbalance 3: 0 g mm"), 0);
}

// Four parts at one place have their names above one another; the line of none goes through the
// name of another.
TEST(SceneDrawing, LinesGoRoundOtherNames) {
    model::Case scene = sample_case();
    for (const char *name : {"impeller", "a balance disc", "nut"}) {
        scene.rotor.discs.push_back(scene.rotor.discs.front());
        scene.rotor.discs.back().name = name;
    }
    const Drawing drawing = show_drawing(scene, results::ShowResult{}, Units::of_readers({}));
    int lines = 0;
    for (const DrawShape &shape : drawing.shapes) {
        if (shape.stroke != "#AAAAAA") // of the lines to the names
            continue;
        ++lines;
        ASSERT_EQ(shape.points.size(), 2U);
        const auto [low, high] = std::minmax(shape.points[0].y, shape.points[1].y);
        for (const DrawText &text : drawing.texts) {
            if (text.text.find("kg") == std::string::npos)
                continue;
            const bool beside =
                std::abs(shape.points[0].x - text.at.x) > text_width(text.text, text.size) / 2;
            const bool apart = high < text.at.y - 0.75 * text.size || low > text.at.y;
            EXPECT_TRUE(beside || apart) << text.text;
        }
    }
    EXPECT_GE(lines, 4);
}

// A shaft that only connects its parts has no mass worth a number.
TEST(SceneDrawing, SaysThatAShaftIsMassless) {
    results::ShowResult result;
    result.mass = 12;
    const auto heading_of = [&](double shaft_mass) {
        result.shaft_mass = shaft_mass;
        std::string all;
        for (const DrawText &text :
             show_drawing(sample_case(), result, Units::of_readers({})).texts)
            all += text.text + "\n";
        return all;
    };
    EXPECT_NE(heading_of(6.4e-8).find("massless shaft"), std::string::npos);
    EXPECT_NE(heading_of(3.5).find("shaft 3.5 kg"), std::string::npos);
}

} // namespace whirl::report
