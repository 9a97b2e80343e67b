// A figure described once: both back-ends have its numbers, names and labels.

#include "report/common/plot_jobs.h"
#include "report/pictures/chart.h"
#include "sample_results.h"
#include "support/svg_texts.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <sstream>

namespace whirl::report {

namespace {

Chart sample_chart() {
    ChartPanel above{
        200, {.title = "x", .low = 0, .high = 3}, {.title = "y", .logarithmic = true}, {}};
    above.curves.push_back(chart_curve("first", {{0, 1}, {1, std::nullopt}, {2, 4}}, 0));
    above.curves.push_back(chart_curve("second", {{0, 10}, {3, 0.125}}, 1));
    above.labels.push_back({"a peak", 2, 4});
    ChartPanel below{100,
                     {.title = "x"},
                     {.title = "phase", .low = -190, .high = 190, .step = 90},
                     {chart_curve("first", {{0, -90}, {3, 90}}, 0)}};
    below.curves.push_back(chart_curve("of pages", {{0, 45}, {3, 45}}, 1));
    below.curves.back().on_page = true;
    return {"title", "", {above, below}};
}

/// Numbers of the data blocks of a script, those without a value left out.
std::vector<std::vector<std::pair<double, double>>> drawn_blocks(const std::string &script) {
    std::vector<std::vector<std::pair<double, double>>> blocks;
    std::istringstream lines(script);
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with("$curve"))
            blocks.emplace_back();
        else if (std::istringstream numbers(line); !blocks.empty()) {
            std::string x, y;
            if (numbers >> x >> y && y != "NaN" && x.find_first_not_of("0123456789.-e") > x.size())
                blocks.back().emplace_back(std::stod(x), std::stod(y));
        }
    return blocks;
}

std::size_t times_in(const std::string &text, const std::string &part) {
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
        ++count;
    return count;
}

} // namespace

TEST(Chart, BothBackEndsHaveTheSameCurves) {
    const Chart chart = sample_chart();
    const auto blocks = drawn_blocks(chart_figure(chart, sample_case(), {}).script);
    const auto panels = chart_json(chart).at("panels");
    ASSERT_EQ(panels.size(), 2U);
    std::size_t block = 0;
    for (std::size_t p = 0; p < 2; ++p)
        for (std::size_t c = 0; c < chart.panels[p].curves.size(); ++c) {
            const auto &curve = panels.at(p).at("curves").at(c);
            EXPECT_EQ(curve.at("name"), chart.panels[p].curves[c].name);
            if (chart.panels[p].curves[c].on_page)
                continue;
            std::vector<std::pair<double, double>> of_page;
            for (const auto &point : curve.at("points"))
                if (!point.at(1).is_null())
                    of_page.emplace_back(point.at(0), point.at(1));
            ASSERT_LT(block, blocks.size());
            EXPECT_EQ(blocks[block++], of_page);
        }
    EXPECT_EQ(block, blocks.size()) << "what is for the page alone is in no file";
}

TEST(Chart, NamesStandInTheLegendOnceAndLabelsBesideTheirPoints) {
    const std::string script = chart_figure(sample_chart(), sample_case(), {}).script;
    EXPECT_EQ(times_in(script, " title " + plot_text("first")), 1U) << "of both panels";
    EXPECT_EQ(times_in(script, plot_text("of pages")), 0U);
    EXPECT_EQ(times_in(script, plot_text("a peak")), 1U);
    EXPECT_EQ(times_in(script, "\nset logscale y"), 1U);
    EXPECT_EQ(times_in(script, "\nset xrange [0:3]"), 1U);
    const auto label = chart_json(sample_chart()).at("panels").at(0).at("labels").at(0);
    EXPECT_EQ(label.at("text"), "a peak");
    EXPECT_EQ(label.at("y"), 4);
}

// By hand: decades below the largest of all (3e2) and of the smallest curve (2), and room above.
TEST(Chart, LogarithmicAxesShowDecadesBelowTheLargest) {
    const std::vector<ChartCurve> curves{chart_curve("", {{0, 1e-9}, {1, 3e2}}, 0),
                                         chart_curve("", {{0, 1e-8}, {1, 2}}, 1)};
    ChartAxis axis;
    span_decades(axis, curves, 1e-6); // from 3e-4
    EXPECT_TRUE(axis.logarithmic);
    EXPECT_DOUBLE_EQ(*axis.low, 1e-4);
    EXPECT_DOUBLE_EQ(*axis.high, 1e3);
    span_decades(axis, curves, 1e-6, 1e-3); // from 2e-3
    EXPECT_DOUBLE_EQ(*axis.low, 1e-3);
    // Above half a decade the label of a peak needs another octave.
    span_decades(axis, {chart_curve("", {{0, 7}, {1, 1}}, 0)}, 1e-6);
    EXPECT_DOUBLE_EQ(*axis.high, 20);
    EXPECT_DOUBLE_EQ(*axis.low, 1);
    span_decades(axis, {chart_curve("", {{0, 0}, {1, 0}}, 0)}, 1e-6);
    EXPECT_FALSE(axis.logarithmic) << "nothing moves";
}

// The areas of a map cover its rectangle once, but for places without a number; each is that of its
// places and ends halfway to those of another level.
TEST(Chart, AreasOfAMapCoverItOnce) {
    const std::vector<double> x{0, 1, 3, 4}, y{10, 20, 40};
    const auto areas = chart_map(x, y, {{-1, -1, 2, 2}, {-1, NAN, 2, 5}, {0, 0, 0, -1}},
                                 {{-0.5, {"low"}}, {1, {"middle"}}, {2, {"high"}}});
    ASSERT_EQ(areas.size(), 3U);
    std::vector<double> sizes;
    for (const ChartCurve &of : areas) {
        double twice = 0; // by the shoelace formula, area by area
        for (std::size_t i = 0; i + 1 < of.points.size(); ++i)
            if (of.points[i].y && of.points[i + 1].y)
                twice +=
                    of.points[i].x * *of.points[i + 1].y - of.points[i + 1].x * *of.points[i].y;
        sizes.push_back(twice / 2);
    }
    // Widths 0.5, 1.5, 1.5, 0.5, heights 5, 15, 10; 5 is more than the last level.
    EXPECT_DOUBLE_EQ(sizes[0], 2 * 5 + 0.5 * 15 + 0.5 * 10);
    EXPECT_DOUBLE_EQ(sizes[1], 3.5 * 10);
    EXPECT_DOUBLE_EQ(sizes[2], 2 * 5 + 1.5 * 15);
    EXPECT_EQ(areas[2].name, "high");
}

TEST(Chart, PiecesThatMeetAreOneLine) {
    std::vector<PlotPoint> line;
    add_piece(line, {0, 0}, {1, 1});
    add_piece(line, {1, 1}, {2, 0});
    add_piece(line, {3, 0}, {4, 1});
    ASSERT_EQ(line.size(), 6U);
    EXPECT_FALSE(line[3].y) << "a gap";
}

// A circle is round: as many pixels up as across.
TEST(Chart, PolarPanelsAreAsWideAsHigh) {
    const Chart chart{"", "", {polar_panel(400, {.title = "x"}, {.title = "y"}, 3)}};
    const Figure figure = chart_figure(chart, sample_case(), {});
    const auto margin = [&figure](const std::string &name) {
        const std::string before = "set " + name + "margin at screen ";
        return std::stod(figure.script.substr(figure.script.find(before) + before.size()));
    };
    EXPECT_NEAR((margin("r") - margin("l")) * figure.width, 400, 1e-9);
    EXPECT_NEAR((margin("t") - margin("b")) * figure.height, 400, 1e-9);
}

// Three squares in one row: at one height, apart, each as wide as high.
TEST(Chart, PanelsOfARowStandBesideOneAnother) {
    Chart chart{"", "", std::vector<ChartPanel>(3, polar_panel(200, {.title = "x"}, {}, 3))};
    chart.panels[1].beside = chart.panels[2].beside = true;
    const Figure figure = chart_figure(chart, sample_case(), {});
    const auto margins = [&figure](const std::string &name) {
        const std::string before = "set " + name + "margin at screen ";
        std::vector<double> found;
        for (std::size_t at = figure.script.find(before); at != std::string::npos;
             at = figure.script.find(before, at + 1))
            found.push_back(std::stod(figure.script.substr(at + before.size())));
        return found;
    };
    const auto left = margins("l"), right = margins("r"), top = margins("t");
    ASSERT_EQ(left.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR((right[i] - left[i]) * figure.width, 200, 1e-9);
        EXPECT_EQ(top[i], top[0]);
        EXPECT_GT(left[i], i == 0 ? 0 : right[i - 1]);
    }
    EXPECT_LT(right[2], 1);
}

// Whatever the case is called and a panel shows: all of it is in the picture.
TEST(Chart, LongTitlesAreNotCut) {
    std::string words;
    for (int i = 0; i < 30; ++i)
        words += fmt::format("word {} ", i);
    for (const int which : {0, 1, 2}) {
        Chart chart = sample_chart();
        (which == 0 ? chart.title : which == 1 ? chart.subtitle : chart.panels[0].title) = words;
        PlotJobs jobs;
        if (!jobs.start(chart_figure(chart, sample_case(), {}), PictureFormat::svg, "a.svg"))
            GTEST_SKIP() << "no gnuplot";
        const std::string svg = jobs.finish().begin()->second;
        EXPECT_NE(svg.find("word 29"), std::string::npos) << which;
        EXPECT_TRUE(tests::layout_faults(svg).empty()) << which;
    }
}

// Both ends of a line at the ends of the panel's axis: beyond these gnuplot would draw none of it.
TEST(Chart, UprightLinesEndWhereTheirPanelDoes) {
    ChartPanel panel{200, {.title = "x", .low = 0, .high = 1}, {.low = -1. / 3, .high = 2e5 / 7}};
    panel.curves = {upright_line(panel, 0.5, {"mark"})};
    const std::string script = chart_figure({"", "", {panel}}, sample_case(), {}).script;
    EXPECT_NE(script.find(fmt::format("set yrange [{}:{}]", -1. / 3, 2e5 / 7)), std::string::npos);
    EXPECT_NE(script.find(fmt::format("\n0.5 {}\n0.5 {}\n", -1. / 3, 2e5 / 7)), std::string::npos);
}

// A picture without a curve is drawn, not refused.
TEST(Chart, PanelsWithoutValuesHaveAxesAllTheSame) {
    Chart chart = sample_chart();
    for (ChartPanel &panel : chart.panels)
        for (ChartCurve &curve : panel.curves)
            curve.points = {{0, std::nullopt}};
    PlotJobs jobs;
    if (!jobs.start(chart_figure(chart, sample_case(), {}), PictureFormat::svg, "a.svg"))
        GTEST_SKIP() << "no gnuplot";
    EXPECT_EQ(jobs.finish().size(), 1U);
    chart.panels.clear();
    EXPECT_TRUE(jobs.start(chart_figure(chart, sample_case(), {}), PictureFormat::svg, "b.svg"));
    EXPECT_EQ(jobs.finish().size(), 1U);
}

} // namespace whirl::report
