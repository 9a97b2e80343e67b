// Pictures in other units: every number of a curve is the one in SI times the factor of what its
// axis shows, and the names of the axes say so.

#include "report/pictures/figures.h"
#include "report/pictures/operation.h"
#include "report/pictures/style.h"
#include "report/response/marks.h"
#include "results/response.h"
#include "results/show.h"
#include "results/simulate.h"
#include "sample_results.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace whirl::report {

namespace {

/// Unlike those of readers in everything.
model::OutputUnits american() {
    model::OutputUnits units;
    units.of = {{"length", {"in", 0.0254}},          {"amplitude", {"mil", 2.54e-5}},
                {"speed", {"Hz", 2 * pi}},           {"frequency", {"rpm", pi / 30}},
                {"force", {"lbf", 4.4482216152605}}, {"stiffness", {"lbf/in", 175.12683524647636}},
                {"mass", {"lb", 0.45359237}}};
    units.peak_to_peak = true;
    return units;
}

const Units other = Units::of_readers(american());

struct Point {
    double x = 0, y = 0;
};
/// The numbers of the data blocks of a script, one block after another; but the rings of a polar
/// plot, which are round numbers in every unit.
std::vector<std::vector<Point>> blocks_of(const std::string &script) {
    std::vector<std::vector<Point>> blocks;
    for (std::size_t at = script.find(" << EOD\n"); at != std::string::npos;
         at = script.find(" << EOD\n", at + 1)) {
        std::istringstream lines(script.substr(at + 8, script.find("\nEOD", at) - at - 8));
        if (script.substr(at - 5, 5) == "rings")
            continue;
        blocks.emplace_back();
        for (std::string line; std::getline(lines, line);) {
            std::istringstream numbers(line);
            std::string x;
            std::string y;
            if (numbers >> x >> y && x != "NaN" && y != "NaN")
                blocks.back().push_back({std::stod(x), std::stod(y)});
        }
    }
    return blocks;
}

/// What the axes of a panel show.
struct Axes {
    Quantity x, y;
};

/// The figure in the usual units and in the others, panel by panel.
/// @param figure  of units
/// @param panels  that it must have, from its first to its last
void expect_scaled(const auto &figure, const std::vector<Axes> &panels) {
    const auto parts = [](const std::string &script) {
        std::vector<std::string> out;
        for (std::size_t at = script.find("set lmargin"); at != std::string::npos;) {
            const std::size_t next = script.find("set lmargin", at + 1);
            out.push_back(script.substr(at, next - at));
            at = next;
        }
        return out;
    };
    const std::vector<std::string> here = parts(figure(usual).script);
    const std::vector<std::string> there = parts(figure(other).script);
    ASSERT_EQ(here.size(), panels.size());
    ASSERT_EQ(there.size(), panels.size());
    constexpr double rounding = 1e-8; // of two numbers, each written with nine digits
    for (std::size_t p = 0; p < panels.size(); ++p) {
        const double x_factor = other.factor(panels[p].x) / usual.factor(panels[p].x);
        const double y_factor = other.factor(panels[p].y) / usual.factor(panels[p].y);
        const auto a = blocks_of(here[p]);
        const auto b = blocks_of(there[p]);
        ASSERT_EQ(a.size(), b.size()) << p;
        std::size_t points = 0;
        for (std::size_t k = 0; k < a.size(); ++k) {
            ASSERT_EQ(a[k].size(), b[k].size()) << p << ", " << k;
            for (std::size_t i = 0; i < a[k].size(); ++i, ++points) {
                EXPECT_NEAR(b[k][i].x, a[k][i].x * x_factor,
                            rounding * std::abs(a[k][i].x * x_factor));
                EXPECT_NEAR(b[k][i].y, a[k][i].y * y_factor,
                            rounding * std::abs(a[k][i].y * y_factor));
            }
        }
        EXPECT_GT(points, 1U) << p;
    }
}

void expect_labels(const Figure &figure, const std::vector<std::string> &labels) {
    for (const std::string &label : labels)
        EXPECT_NE(figure.script.find(plot_text(label)), std::string::npos) << label;
    for (const char *usual_name : {"(rpm)", "(Hz)", "(µm)", "(m)", "(N)", " m\"", " m,"})
        if (std::ranges::none_of(labels, [&](const std::string &label) {
                return label.find(usual_name) != std::string::npos;
            }))
            EXPECT_EQ(figure.script.find(plot_text(usual_name).substr(1, 5)), std::string::npos)
                << usual_name;
}

} // namespace

TEST(PictureUnits, OfACampbellDiagramAreThoseOfSpeedsAndFrequencies) {
    const results::CampbellResult result = sample_campbell();
    const auto figure = [&](const Units &units) {
        return chart_figure(campbell_chart(sample_case(), result, units), sample_case(), units);
    };
    using enum Quantity;
    expect_scaled(figure, {{speed, frequency}, {speed, number}});
    expect_labels(figure(other), {"Spin speed (Hz)", "Whirl frequency (rpm)"});
}

TEST(PictureUnits, OfAResponseAreThoseOfPeaksAndForces) {
    results::ResponseResult result;
    result.speeds = {100, 200, 300};
    result.nodes.resize(1);
    result.nodes[0].name = "race";
    result.nodes[0].z = 0.175;
    result.nodes[0].amplitude = {1e-6, 5e-5, 2e-5};
    result.nodes[0].phase = {-0.1, -1.5, -3};
    result.bearings.resize(1);
    result.bearings[0].force = {10, 200, 40};
    results::ResponsePeak peak;
    peak.of = "station";
    peak.speed = 210;
    peak.value = 6e-5;
    peak.lower = 190;
    result.peaks = {peak};
    const auto figure = [&](const Units &units) {
        return chart_figure(response_chart(sample_case(), result, units), sample_case(), units);
    };
    using enum Quantity;
    expect_scaled(figure, {{speed, amplitude}, {speed, number}, {speed, force}});
    expect_labels(figure(other), {"Spin speed (Hz)", "Amplitude pk-pk (mil)",
                                  "Largest bearing force (lbf)", "race, z = 6.89 in"});
    const auto polar = [&](const Units &units) {
        return chart_figure(polar_chart(sample_case(), result, units), sample_case(), units);
    };
    expect_scaled(polar, {{amplitude, amplitude}});
    expect_labels(polar(other), {"x pk-pk (mil)", "33.42 Hz"});
}

// A deflection is no amplitude: it is never written from peak to peak.
TEST(PictureUnits, OfAMotionTellPeaksFromDeflections) {
    results::SimulateResult result;
    result.series.time = {0, 1, 2};
    result.series.speed = {100, 100, 100};
    result.series.amplitude = {{1e-5, 3e-5, 2e-5}};
    result.series.x = {{1e-5, -3e-5, 2e-5}};
    result.series.y = {{2e-5, 1e-5, -1e-5}};
    result.stations.resize(1);
    result.stations[0].z = 0.5;
    result.stations[0].peak = {3e-5, 1, 100, false};
    const auto figure = [&](const Units &units) {
        return chart_figure(simulate_chart(sample_case(), result, units), sample_case(), units);
    };
    using enum Quantity;
    expect_scaled(figure, {{number, amplitude}, {number, deflection}});
    expect_labels(figure(other), {"Amplitude pk-pk (mil)", "Deflection (mil)", "z = 19.69 in"});
    result.series.speed = {50, 100, 150};
    result.steady = {{50, 150}, {{1e-5, 2e-5}}};
    expect_scaled(figure, {{number, amplitude}, {speed, amplitude}, {number, speed}});
    expect_labels(figure(other), {"Spin speed (Hz)", "Speed (Hz)"});
}

TEST(PictureUnits, OfModesAreThoseOfPlaces) {
    const auto figure = [&](const Units &units) {
        return chart_figure(modes_chart(sample_case(), sample_modes(), units), sample_case(),
                            units);
    };
    expect_labels(figure(other), {"z (in)", "1B · 763.94 rpm · backward"});
    const std::string script = figure(other).script;
    EXPECT_NE(script.find("\n0 0.3\n"), std::string::npos);
    EXPECT_NE(script.find(fmt::format("\n{} 1\n", 0.75 / 0.0254)), std::string::npos);
}

TEST(PictureUnits, OfTheDrawingAreThoseOfItsParts) {
    model::Case scene = sample_case();
    scene.rotor.imbalances.resize(1);
    scene.rotor.imbalances[0].mr = 2e-5;
    const auto texts = [&](const Units &units) {
        std::string all;
        for (const DrawText &text : scene_drawing(scene, units).texts)
            all += text.text + "\n";
        return all;
    };
    EXPECT_NE(texts(usual).find("imbalance: 20 g mm\n"), std::string::npos) << texts(usual);
    EXPECT_NE(texts(usual).find("bearing 1: 10⁶ N/m\n"), std::string::npos);
    EXPECT_NE(texts(usual).find("\nz (m)"), std::string::npos);
    EXPECT_NE(texts(other).find("bearing 1: 5710 lbf/in\n"), std::string::npos) << texts(other);
    EXPECT_NE(texts(other).find("\nz (in)"), std::string::npos);
    EXPECT_NE(
        texts(other).find(fmt::format("disc: {:.4g} lb\n", scene.rotor.discs[0].mass / 0.45359237)),
        std::string::npos);
}

} // namespace whirl::report
