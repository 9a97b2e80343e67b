#include "report/common/plotly.h"
#include "results/campbell.h"
#include "results/formulation.h"
#include "results/modes.h"
#include "sample_results.h"

#include <nlohmann/json.hpp>

#include <regex>

namespace whirl::report {

namespace {

std::string without_bundle(std::string html) {
    const std::string_view bundle = plotly_bundle();
    const std::size_t at = bundle.empty() ? std::string::npos : html.find(bundle);
    return at == std::string::npos ? html : html.erase(at, bundle.size());
}

} // namespace

TEST(Html, LoadsNothingFromElsewhere) {
    const std::string html = without_bundle(to_html(sample_case(), sample_campbell(), "<svg/>"));
    const std::regex reference(R"((src|href|srcset|data)\s*=\s*"(?!data:)[^"]*"|@import|url\()");
    std::smatch found;
    EXPECT_FALSE(std::regex_search(html, found, reference)) << found.str();
}

TEST(Html, HoldsPlotlyOrSaysThatItIsAStillPicture) {
    const std::string html = to_html(sample_case(), sample_campbell(), "<svg id=\"still\"/>");
    if (plotly_bundle().empty()) {
        EXPECT_NE(html.find("<svg id=\"still\"/>"), std::string::npos);
        EXPECT_NE(html.find("still picture"), std::string::npos);
    } else {
        EXPECT_GT(plotly_bundle().size(), 500000u);
        EXPECT_NE(html.find(plotly_bundle()), std::string::npos);
        EXPECT_EQ(plotly_bundle().find("</script"), std::string_view::npos);
    }
}

TEST(Html, TitleIsEscapedAndCannotEndTheDataElement) {
    model::Case scene = sample_case();
    scene.title = "</script><script>alert(1)</script>";
    const std::string html = without_bundle(to_html(scene, sample_campbell(), ""));
    EXPECT_EQ(html.find("<script>alert"), std::string::npos);
    EXPECT_NE(html.find("&lt;script&gt;alert"), std::string::npos);
    const std::string open = "type=\"application/json\">";
    const std::size_t start = html.find(open) + open.size();
    const auto data =
        nlohmann::json::parse(html.substr(start, html.find("</script>", start) - start));
    EXPECT_EQ(data.at("title"), scene.title);
}

TEST(Html, SaysInWhichAxesTheFormIs) {
    using results::Form;
    results::CampbellResult result = sample_campbell();
    for (const Form form : {Form::planar, Form::hyperbolic, Form::general}) {
        result.model.formulation.form = form;
        const std::string html = without_bundle(to_html(sample_case(), result, ""));
        EXPECT_NE(html.find(results::form_name(form) + " form, in the fixed frame: isotropic"),
                  std::string::npos);
    }
    for (const Form form : {Form::rotating, Form::hill}) {
        result.model.formulation.form = form;
        const std::string html = without_bundle(to_html(sample_case(), result, ""));
        EXPECT_EQ(html.find("fixed frame"), std::string::npos) << results::form_name(form);
        EXPECT_NE(html.find(results::form_name(form) + " form, in axes that turn with the rotor"),
                  std::string::npos);
    }
}

TEST(Html, TablesShowCrossingsAndOverdampedModes) {
    results::CampbellResult result = sample_campbell();
    result.modes[1].frequency[2].reset();
    result.modes[1].absent[2] = "overdamped";
    const std::string html = without_bundle(to_html(sample_case(), result, ""));
    EXPECT_NE(html.find("<td>82.5</td>"), std::string::npos) << "crossing in rad/s";
    EXPECT_NE(html.find("<td>overdamped</td>"), std::string::npos);
    EXPECT_NE(html.find("isotropic &amp; undamped"), std::string::npos);
}

TEST(Html, ModesAreDrawnByTheCurvesOfTheStillPicture) {
    results::ModesResult result = sample_modes();
    result.modes[0].x.assign(3, 0); // straight up and down, in phase with nothing in x
    result.modes[0].y = {0.25, 1, -0.5};
    const std::string html = without_bundle(to_html(sample_case(), result, ""));
    if (plotly_bundle().empty())
        GTEST_SKIP() << "the page has no script";
    EXPECT_NE(html.find("y: [0.25,1,-0.5]"), std::string::npos);
    EXPECT_NE(html.find("drawnModes[k].y"), std::string::npos);
}

} // namespace whirl::report
