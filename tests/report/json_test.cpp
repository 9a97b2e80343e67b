#include "results/accuracy.h"
#include "results/critical.h"
#include "results/response.h"
#include "results/show.h"
#include "results/whirl.h"
#include "sample_results.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <numbers>

namespace whirl::report {

using AnyJson = nlohmann::json;

TEST(Json, EnvelopeNamesProgramFormatAndFormulation) {
    const AnyJson json = AnyJson::parse(to_json(sample_case(), sample_campbell()));
    EXPECT_EQ(json.at("program"), "whirl");
    EXPECT_EQ(json.at("version"), program_version());
    EXPECT_EQ(json.at("format"), 1);
    EXPECT_EQ(json.at("command"), "campbell");
    EXPECT_EQ(json.at("case"), "sample");
    EXPECT_EQ(json.at("title"), wicked_title);
    EXPECT_EQ(json.at("formulation").at("frame"), "fixed");
    EXPECT_EQ(json.at("formulation").at("unknowns"), "planar");
    EXPECT_EQ(json.at("formulation").at("form"), "planar");
    EXPECT_EQ(json.at("formulation").at("why"), "isotropic & undamped");
    EXPECT_EQ(json.at("order"), 4);
    EXPECT_EQ(json.at("elements"), 6);
    EXPECT_EQ(json.at("unknowns_count"), 50);
    EXPECT_EQ(json.at("notes"), AnyJson::array({"a note"}));
}

TEST(Json, SaysWhatItWasComputedFrom) {
    const model::Case scene = sample_case();
    const results::CampbellResult result = sample_campbell();
    Report report = describe(scene, result);
    report.provenance = {"2026-03-01T12:00:00Z",
                         "title = \"</pre><b>\"\n# second line\n",
                         {"title=\"<i>\"", "units.preset=us"}};
    const AnyJson told = AnyJson::parse(to_json(report)).at("provenance");
    EXPECT_EQ(told.at("version"), program_version());
    EXPECT_EQ(told.at("date"), "2026-03-01T12:00:00Z");
    EXPECT_EQ(told.at("case"), report.provenance.case_text);
    EXPECT_EQ(told.at("set"), AnyJson(report.provenance.set));
    const std::string page = to_html(report, "");
    EXPECT_NE(page.find("title = \"&lt;/pre&gt;&lt;b&gt;\"\n# second line\n</pre></details>"),
              std::string::npos);
    EXPECT_NE(page.find("# --set \"title=\"&lt;i&gt;\"\"\n# --set \"units.preset=us\"\ntitle"),
              std::string::npos);
    EXPECT_NE(page.find("2026-03-01T12:00:00Z"), std::string::npos);
}

TEST(Json, CampbellKeepsAllDigitsAndWritesNullForWhatIsMissing) {
    const std::string text = to_json(sample_case(), sample_campbell());
    const AnyJson json = AnyJson::parse(text);
    const AnyJson &modes = json.at("modes");
    EXPECT_EQ(modes.at(0).at("frequency").at(0).get<double>(), 85.389371234123);
    EXPECT_TRUE(modes.at(1).at("frequency").at(1).is_null());
    EXPECT_TRUE(modes.at(1).at("real").at(1).is_null()) << "NaN";
    EXPECT_TRUE(modes.at(1).at("error").at(2).is_null()) << "infinity";
    EXPECT_EQ(modes.at(0).at("whirl"), AnyJson::array({"mixed", "backward", "backward"}));
    EXPECT_EQ(json.at("crossings").at(0).at("speed"), 82.5);
    EXPECT_EQ(json.at("crossings").at(0).at("mode"), 0);
    EXPECT_EQ(json.at("crossings").at(0).at("multiple"), 1);
    const double ratio = 33 / std::hypot(33, 82.5);
    EXPECT_DOUBLE_EQ(json.at("crossings").at(0).at("damping_ratio"), ratio);
    EXPECT_DOUBLE_EQ(json.at("crossings").at(0).at("log_dec"), 2 * std::numbers::pi * 0.4);
    EXPECT_DOUBLE_EQ(json.at("crossings").at(0).at("amplification"), 1 / (2 * ratio));
    EXPECT_EQ(json.at("locked"),
              AnyJson::parse(R"([{"multiple": 1.0, "mode": 1, "from": 90.0, "to": 110.0}])"));
    for (const char *key :
         {"label", "frequency", "real", "damping_ratio", "log_dec", "whirl", "forward_fraction",
          "error", "error_mesh", "error_reduction", "error_rounding", "residual"})
        EXPECT_TRUE(modes.at(1).contains(key)) << key;
    EXPECT_EQ(text.find("NaN"), std::string::npos);
}

TEST(Json, OtherResultsHaveTheirKeys) {
    results::CriticalResult critical;
    critical.critical_speeds = {
        {86.5, results::Whirl::backward, 0, 1e-12, 1e-15, results::damping_of({0, 86.5}), "1B"},
        {90, results::Whirl::forward, -30, 1e-12, 1e-15, results::damping_of({-30, 90}), ""}};
    const AnyJson speeds = AnyJson::parse(to_json(sample_case(), critical)).at("critical_speeds");
    EXPECT_EQ(speeds.at(0).at("speed"), 86.5);
    EXPECT_EQ(speeds.at(0).at("mode"), "1B");
    EXPECT_TRUE(speeds.at(1).at("mode").is_null()) << "not known";
    EXPECT_EQ(speeds.at(0).at("whirl"), "backward");
    EXPECT_EQ(speeds.at(0).at("error"), 1e-12);
    for (const char *part : {"error_mesh", "error_reduction", "error_rounding"})
        EXPECT_TRUE(speeds.at(0).contains(part)) << part;
    EXPECT_EQ(speeds.at(0).at("damping_ratio"), 0);
    EXPECT_TRUE(speeds.at(0).at("amplification").is_null()) << "nothing limits it";
    EXPECT_EQ(speeds.at(0).at("heavily_damped"), false);
    EXPECT_DOUBLE_EQ(speeds.at(1).at("amplification"), std::sqrt(10.) / 2);
    EXPECT_EQ(speeds.at(1).at("heavily_damped"), true);

    results::ResponseResult response;
    response.speeds = {100};
    response.nodes.resize(1);
    response.nodes[0].minor = {-1e-6};
    response.nodes[0].inclination = {std::nan("")};
    response.bearings = {{0, "", {12.5}, {1e-8}}};
    response.probes = {{0.5, 0.7, "left", {1e-5}, {0.2}, {1e-9}}};
    const AnyJson answered = AnyJson::parse(to_json(sample_case(), response));
    EXPECT_EQ(answered.at("nodes").at(0).at("minor").at(0), -1e-6);
    for (const char *key : {"z", "name", "amplitude", "phase", "major", "minor", "x", "x_phase",
                            "y", "y_phase", "inclination", "error"})
        EXPECT_TRUE(answered.at("nodes").at(0).contains(key)) << key;
    EXPECT_TRUE(answered.at("nodes").at(0).at("inclination").at(0).is_null());
    EXPECT_EQ(answered.at("bearings").at(0).at("force").at(0), 12.5);
    EXPECT_EQ(answered.at("bearings").at(0).at("error").at(0), 1e-8);
    EXPECT_EQ(answered.at("probes").at(0).at("angle"), 0.7);
    EXPECT_EQ(answered.at("probes").at(0).at("phase").at(0), 0.2);

    EXPECT_FALSE(answered.contains("gravity")) << "not asked for";
    response.gravity.emplace().gravity = 9.81;
    response.gravity->stations.push_back(
        {0.5, "disc", {3e-5}, {1e-6}, {-3e-5}, {1e-6}, {0.3}, {1e-9}, {1e-11}});
    response.gravity->bearings.push_back({0, "left", {44}, {2.5}, {1e-8}, {1e-10}});
    response.gravity->peaks.emplace_back().value = std::numeric_limits<double>::infinity();
    const AnyJson weight = AnyJson::parse(to_json(sample_case(), response)).at("gravity");
    EXPECT_EQ(weight.at("gravity"), 9.81);
    EXPECT_EQ(weight.at("stations").at(0).at("static").at(0), 3e-5);
    EXPECT_EQ(weight.at("stations").at(0).at("static_y").at(0), -3e-5);
    EXPECT_EQ(weight.at("stations").at(0).at("twice").at(0), 1e-6);
    EXPECT_EQ(weight.at("bearings").at(0).at("static").at(0), 44);
    EXPECT_EQ(weight.at("bearings").at(0).at("twice").at(0), 2.5);
    EXPECT_TRUE(weight.at("peaks").at(0).at("value").is_null());

    results::ShowResult show;
    show.mass = 84;
    const AnyJson shown = AnyJson::parse(to_json(sample_case(), show));
    EXPECT_EQ(shown.at("mass"), 84);
    for (const char *key : {"center_of_mass", "Id", "Ip", "type", "balancers"})
        EXPECT_TRUE(shown.contains(key)) << key;

    results::AccuracyResult accuracy;
    accuracy.rows = {{"classical", 1, 6, "full", 14, 1e-3, std::nullopt, 2e-4}};
    const AnyJson row = AnyJson::parse(to_json(sample_case(), accuracy)).at("rows").at(0);
    EXPECT_TRUE(row.at("error_estimate").is_null());
    EXPECT_EQ(row.at("true_error"), 2e-4);
    EXPECT_EQ(row.at("family"), "classical");
}

TEST(Json, TextThatIsNotUtf8IsReplacedNotRefused) {
    model::Case scene = sample_case();
    scene.title = "bad \xff byte";
    EXPECT_TRUE(AnyJson::accept(to_json(scene, sample_campbell())));
}

} // namespace whirl::report
