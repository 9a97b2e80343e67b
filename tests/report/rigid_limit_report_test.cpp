#include "report/common/units.h"
#include "results/rigid_limit.h"
#include "sample_results.h"
#include "whole_report.h"

#include <nlohmann/json.hpp>

namespace whirl::report {

namespace {

/// A speed over stiffness, ending with the rigid model, and a mass over meshes.
results::RigidLimitResult sample_rigid_limit() {
    const double infinite = std::numeric_limits<double>::infinity();
    results::RigidLimitResult result;
    result.model.notes = {"a note"};
    result.stiffness = 1e6;
    result.bearing_stiffness = 2e6;
    result.mesh_factor = 100;
    result.sentence = "within 1 % <once>";
    result.one_percent = results::RigidShaft{12, 1.2e7, 6, 0.01, "critical speed"};
    results::RigidLimitRow speed;
    speed.quantity = "additional speed, pinned at \"it's <one>\"";
    speed.of = Quantity::speed;
    speed.closed_form = 100;
    speed.factor = {1, 100, infinite};
    speed.stiffness = {1e6, 1e8, infinite};
    speed.fe = {std::nullopt, 99., 100.};
    speed.relative_difference = {std::nullopt, 0.01, 0.};
    speed.rounding = {std::nullopt, 1e-12, 1e-15};
    speed.rate = -1;
    results::RigidLimitRow mass;
    mass.quantity = "mass";
    mass.of = Quantity::mass;
    mass.closed_form = 3;
    mass.speed = false;
    mass.inertia = true;
    mass.factor = {100, 100};
    mass.elements = {2, 1};
    mass.fe = {3., 3.};
    mass.relative_difference = {0., 1e-16};
    result.rows = {speed, mass};
    return result;
}

} // namespace

class RigidLimitReport : public ScratchFolder {};

TEST_F(RigidLimitReport, RowsHaveStiffnessOrElements) {
    const auto json = nlohmann::json::parse(to_json(sample_case(), sample_rigid_limit()));
    EXPECT_EQ(json.at("command"), "rigid-limit");
    EXPECT_EQ(json.at("one_percent_stiffness"), 1.2e7);
    const auto &rows = json.at("rows");
    EXPECT_EQ(rows.at(0).at("stiffness").dump(), "[1000000.0,100000000.0,null]");
    EXPECT_FALSE(rows.at(0).contains("elements"));
    EXPECT_EQ(rows.at(0).at("fe").dump(), "[null,99.0,100.0]");
    EXPECT_EQ(rows.at(0).at("rate"), -1);
    EXPECT_EQ(rows.at(1).at("elements").dump(), "[2,1]");
    EXPECT_FALSE(rows.at(1).contains("stiffness"));
    EXPECT_TRUE(rows.at(1).at("rate").is_null());
}

TEST_F(RigidLimitReport, CsvQuotesNamesAndLeavesMissingCellsEmpty) {
    const std::string csv = to_csv(sample_rigid_limit());
    EXPECT_NE(csv.find("\"additional speed, pinned at \"\"it's <one>\"\"\""), std::string::npos);
    EXPECT_NE(csv.find(",1,1000000,100,,,-1\n"), std::string::npos) << csv;
    EXPECT_EQ(csv.find("inf"), std::string::npos) << csv;
}

// Every row in the unit asked for of what it is, on the page, the terminal and in the table.
TEST_F(RigidLimitReport, RowsAreInTheUnitsAskedFor) {
    model::Case scene = sample_case();
    scene.units.of = {{"speed", {"rpm", pi / 30}}, {"mass", {"lb", 0.5}}};
    results::RigidLimitResult result = sample_rigid_limit();
    result.rows[0].quantity = "critical speed";
    const std::string csv = describe(scene, result).csv(Units::of_files(scene.units));
    EXPECT_NE(csv.find("critical speed,rpm"), std::string::npos) << csv;
    EXPECT_NE(csv.find(",954.929658551"), std::string::npos) << csv; // 100 rad/s
    EXPECT_NE(csv.find("mass,lb"), std::string::npos) << csv;
    EXPECT_NE(csv.find(",6,6,"), std::string::npos) << csv; // 3 kg in halves
    (void)write_report(scene, result, folder);
    for (const std::string &text :
         {to_text(describe(scene, result), {10, true, 0}), content_of(folder / "report.html")}) {
        EXPECT_NE(text.find("critical speed (rpm)"), std::string::npos) << text;
        EXPECT_NE(text.find("954.9296586"), std::string::npos) << text;
        EXPECT_NE(text.find("mass (lb)"), std::string::npos) << text;
    }
    const auto json = nlohmann::json::parse(to_json(scene, result));
    EXPECT_EQ(json.at("rows").at(0).at("closed_form"), 100); // SI
}

TEST_F(RigidLimitReport, WritesPicturesDataAndPage) {
    const Files files = write_report(sample_case(), sample_rigid_limit(), folder);
    for (const auto &path : files.paths)
        EXPECT_GT(std::filesystem::file_size(path), 50u) << path;
    const std::string page = content_of(folder / "report.html");
    EXPECT_NE(page.find("within 1 % &lt;once&gt;"), std::string::npos);
    EXPECT_EQ(page.find("<one>"), std::string::npos);
    if (files.notes.empty()) { // drawn: the page shows the picture
        EXPECT_NE(page.find("<svg", page.find("Flexible model and rigid closed forms</h2>")),
                  std::string::npos);
    }
    const Files nothing =
        write_report(model::Case{}, results::RigidLimitResult{}, folder / "empty");
    const auto json = expect_whole_report(nothing, folder / "empty", "rigid-limit");
    EXPECT_EQ(json.at("rows"), nlohmann::json::array());
    EXPECT_EQ(lines_of(content_of(folder / "empty/rigid-limit.csv")).size(), 1U) << "the header";
}

} // namespace whirl::report
