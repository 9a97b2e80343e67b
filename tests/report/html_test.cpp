#include "report/common/html.h"
#include "results/campbell.h"
#include "results/formulation.h"
#include "results/modes.h"
#include "sample_results.h"

#include <nlohmann/json.hpp>
#include <pugixml.hpp>

#include <cmath>
#include <regex>

namespace whirl::report {

namespace {

std::string without_bundle(std::string html) {
    const std::string_view bundle = plotly_bundle();
    const std::size_t at = bundle.empty() ? std::string::npos : html.find(bundle);
    return at == std::string::npos ? html : html.erase(at, bundle.size());
}

/// What the scripts of a page draw.
nlohmann::json data_of(const std::string &html) {
    const std::string open = "type=\"application/json\">";
    const std::size_t start = html.find(open) + open.size();
    return nlohmann::json::parse(html.substr(start, html.find("</script>", start) - start));
}

} // namespace

TEST(Html, LoadsNothingFromElsewhere) {
    const std::string page = without_bundle(to_html(sample_case(), sample_campbell(), "<svg/>"));
    // A link to a place of the page or to a file beside it loads nothing by itself.
    const std::regex link(R"re(<a href="(#[a-z0-9-]+|[a-z0-9_-]+\.[a-z]+)">)re");
    const std::string html = std::regex_replace(page, link, "<a>");
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

TEST(Html, ContentsListEveryHeadingInOrder) {
    const std::string html = without_bundle(to_html(sample_case(), sample_campbell(), ""));
    std::vector<std::string> headings;
    const std::regex heading(R"re(<h2 id="([^"]+)">(.*?)</h2>)re");
    for (std::sregex_iterator at(html.begin(), html.end(), heading), end; at != end; ++at)
        headings.push_back("<a href=\"#" + at->str(1) + "\">" + at->str(2) + "</a>");
    ASSERT_GE(headings.size(), 3U);
    EXPECT_EQ(html.find("<h2>"), std::string::npos) << "a heading that nothing leads to";
    std::size_t from = html.find("<ul id=\"contents\">");
    for (const std::string &link : headings) {
        const std::size_t at = html.find(link, from);
        ASSERT_NE(at, std::string::npos) << link;
        from = at;
    }
    EXPECT_LT(from, html.find("<h2 id"));
}

TEST(Html, PicturesSayWhatTheyAreAndCannotEndTheirLabel) {
    const std::string html = picture_element("<?xml?>\n<svg a=\"b\"/>", "a \"quoted\" <title>");
    pugi::xml_document document;
    ASSERT_TRUE(document.load_string(html.c_str())) << html;
    const pugi::xml_node figure = document.child("figure");
    EXPECT_STREQ(figure.attribute("aria-label").value(), "a \"quoted\" <title>");
    EXPECT_STREQ(figure.child("svg").attribute("a").value(), "b");
    EXPECT_EQ(picture_element("", "none"), "");
}

TEST(Html, TitleIsEscapedAndCannotEndTheDataElement) {
    model::Case scene = sample_case();
    scene.title = "</script><script>alert(1)</script>";
    const std::string html = without_bundle(to_html(scene, sample_campbell(), ""));
    EXPECT_EQ(html.find("<script>alert"), std::string::npos);
    EXPECT_NE(html.find("&lt;script&gt;alert"), std::string::npos);
    EXPECT_EQ(data_of(html).at("title"), scene.title);
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
    const nlohmann::json data = data_of(html);
    const auto &curves = data["chart"]["panels"][0]["curves"];
    const auto y = std::ranges::find_if(curves, [](const auto &of) { return of["name"] == "y"; });
    ASSERT_NE(y, curves.end());
    for (const auto &[point, expected] : {std::pair(0, 0.25), {1, 1.0}, {2, -0.5}})
        EXPECT_EQ((*y)["points"][point][1], expected);
}

// The scripts know no units: each number of their data is the one of the result in SI times the
// factor of its quantity, whose name stands beside it.
TEST(Html, DataAreInTheUnitsOfTheReaders) {
    model::Case scene = sample_case();
    scene.units.of = {{"length", {"in", 0.0254}}, {"frequency", {"rpm", pi / 30}}};
    const nlohmann::json data = data_of(without_bundle(to_html(scene, sample_modes(), "")));
    EXPECT_EQ(data["units"]["length"], "in");
    EXPECT_EQ(data["units"]["frequency"], "rpm");
    EXPECT_EQ(data["units"]["speed"], "rpm");
    const auto near = [](const nlohmann::json &found, double expected) {
        return std::abs(found.get<double>() - expected) <= 1e-14 * std::abs(expected);
    };
    EXPECT_TRUE(near(data["speed"], 100 * 30 / pi));
    EXPECT_TRUE(near(data["z"][1], 0.75 / 0.0254));
    EXPECT_TRUE(near(data["modes"][0]["frequency"], 80 * 30 / pi));
    EXPECT_TRUE(near(data["drawn"]["rotor"]["length"], 1.5 / 0.0254));
    EXPECT_EQ(data["drawn"]["modes"][1], fmt::format("1F · {:.5g} rpm · damping ratio {:.3g} · "
                                                     "forward",
                                                     90 * 30 / pi, 2 / std::hypot(2, 90)));
    results::CampbellResult result = sample_campbell();
    result.modes[1].error[2] = 1e-3; // growth of 2 beside 110 rad/s is more
    const nlohmann::json campbell = data_of(without_bundle(to_html(scene, result, "")));
    EXPECT_TRUE(near(campbell["crossings"][0]["frequency"], 82.5 * 30 / pi));
    std::vector<nlohmann::json> synchronous; // a line
    std::vector<nlohmann::json> growing;
    for (const auto &curve : campbell["chart"]["panels"][0]["curves"])
        if (curve["colour"] == "#777777")
            synchronous.push_back(curve["points"][1]);
        else if (curve["name"] == "unstable")
            growing.push_back(curve["points"]);
    ASSERT_EQ(synchronous.size(), 1U);
    EXPECT_TRUE(near(synchronous[0][0], synchronous[0][1])) << "rpm over rpm";
    ASSERT_EQ(growing.size(), 1U);
    ASSERT_EQ(growing[0].size(), 1U) << "at the third speed alone";
    EXPECT_TRUE(near(growing[0][0][1], 110 * 30 / pi));
}

} // namespace whirl::report
