#include "report/pictures/figures.h"

#include "report/pictures/style.h"
#include "results/weights.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>

namespace whirl::report {

using results::WeightsResult;

namespace {

constexpr std::size_t most_speeds = 3; ///< with a panel of readings each
constexpr int panel_size = 400;        // pixels

PlotPoint point_of(std::complex<double> value, double factor) {
    return {factor * value.real(), factor * value.imag()};
}

/// Angles are as they are in the case.
ChartPanel panel_of(const Units &units, Quantity quantity, double largest,
                    const std::string &title) {
    ChartPanel panel =
        polar_panel(panel_size, chart_axis(units, "at 0°", quantity),
                    chart_axis(units, "at 90°", quantity), units.factor(quantity) * largest);
    panel.title = title;
    return panel;
}

std::vector<std::string> names_of_probes(const WeightsResult &result) {
    std::vector<std::string> names;
    for (const results::WeightReading &reading : result.residual)
        if (std::find(names.begin(), names.end(), reading.probe) == names.end())
            names.push_back(reading.probe);
    return names;
}

std::vector<std::optional<double>> speeds_of(const WeightsResult &result) {
    std::vector<std::optional<double>> speeds;
    for (const results::WeightReading &reading : result.residual)
        if (std::find(speeds.begin(), speeds.end(), reading.speed) == speeds.end())
            speeds.push_back(reading.speed);
    return speeds;
}

/// Readings at one speed: a line from what is read to what will be.
ChartPanel readings_panel(const Units &units, const WeightsResult &result,
                          const std::optional<double> &speed) {
    const double factor = units.factor(Quantity::amplitude);
    const std::vector<std::string> names = names_of_probes(result);
    double largest = 0;
    for (const results::WeightReading &reading : result.residual)
        if (reading.speed == speed)
            largest = std::max({largest, std::abs(reading.before), std::abs(reading.after)});
    ChartPanel panel =
        panel_of(units, Quantity::amplitude, largest,
                 speed ? "Readings at " + drawn_value(units, Quantity::speed, *speed) : "Readings");
    for (const results::WeightReading &reading : result.residual) {
        if (reading.speed != speed)
            continue;
        const std::string colour =
            series_style(
                static_cast<std::size_t>(std::ranges::find(names, reading.probe) - names.begin()))
                .colour;
        const PlotPoint before = point_of(reading.before, factor);
        const PlotPoint after = point_of(reading.after, factor);
        panel.curves.push_back({"", {before, after}, {"", colour}, 1.2});
        panel.curves.push_back({"", {before}, {"", colour, "1", 6}, 0, 1.3});
        panel.curves.push_back({reading.probe, {after}, {"", colour, "1", 7}, 0, 1.1});
    }
    return panel;
}

ChartPanel weights_panel(const Units &units, const WeightsResult &result) {
    const double factor = units.factor(Quantity::imbalance);
    double largest = 0;
    for (const results::CorrectionWeight &weight : result.weights)
        largest = std::max(largest, std::abs(weight.weight));
    ChartPanel panel = panel_of(units, Quantity::imbalance, largest, "Weights to add");
    for (std::size_t i = 0; i < result.weights.size(); ++i) {
        const results::CorrectionWeight &weight = result.weights[i];
        const std::string colour = series_style(i).colour;
        const PlotPoint tip = point_of(weight.weight, factor);
        panel.curves.push_back({"", {{0, 0.0}, tip}, {"", colour}, 2});
        panel.curves.push_back({"", {tip}, {"", colour}, 0, 1.3});
        if (weight.scatter) {
            ChartCurve circle{
                "", circle_points(factor * *weight.scatter), {"", colour, "(4,4)"}, 0.8};
            for (PlotPoint &point : circle.points)
                point = {point.x + tip.x, *point.y + *tip.y};
            panel.curves.push_back(circle);
        }
        panel.labels.push_back({weight.plane, tip.x, *tip.y, colour});
    }
    return panel;
}

ChartPanel curves_panel(const Units &units, const WeightsResult &result) {
    ChartPanel panel{280, along_speeds(units, result.curve_speeds),
                     chart_axis(units, "Amplitude", Quantity::amplitude)};
    const auto points = [&](const std::vector<std::optional<double>> &values) {
        std::vector<PlotPoint> line;
        for (std::size_t i = 0; i < values.size(); ++i) {
            line.push_back({units(Quantity::speed, result.curve_speeds[i]), std::nullopt});
            if (values[i] && *values[i] > 0) // zero has no logarithm
                line.back().y = units(Quantity::amplitude, *values[i]);
        }
        return line;
    };
    for (std::size_t i = 0; i < result.curves.size(); ++i) {
        panel.curves.push_back(chart_curve("", points(result.curves[i].before), i, 1.1, "(5,4)"));
        panel.curves.push_back(chart_curve("", points(result.curves[i].after), i, 2, "1"));
    }
    span_decades(panel.y, panel.curves, 1e-5);
    for (const std::optional<double> &own : speeds_of(result))
        if (own)
            panel.curves.push_back(
                upright_line(panel, units(Quantity::speed, *own), {"", "#999999", "(8,4)"}));
    return panel;
}

} // namespace

Chart weights_chart(const model::Case &scene, const WeightsResult &result, const Units &units) {
    const std::vector<std::optional<double>> speeds = speeds_of(result);
    Chart chart{"Correction weights: " + title_of(scene),
                "open marks: before, filled: after; angles are the phases of the case",
                {}};
    for (std::size_t i = 0; i < std::min(speeds.size(), most_speeds); ++i)
        chart.panels.push_back(readings_panel(units, result, speeds[i]));
    chart.panels.push_back(weights_panel(units, result));
    for (std::size_t i = 1; i < chart.panels.size(); i += 2)
        chart.panels[i].beside = true;
    if (speeds.size() > most_speeds)
        chart.subtitle += fmt::format("; {} of {} speeds", most_speeds, speeds.size());
    if (!result.curves.empty()) {
        chart.panels.push_back(curves_panel(units, result));
        chart.subtitle += "; below dashed: before";
    }
    return chart;
}

} // namespace whirl::report
