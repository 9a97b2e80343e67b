#include "report/common/column.h"
#include "report/common/words.h"
#include "report/compare/comparison.h"
#include "report/pictures/chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

namespace whirl::report {

namespace {

/// Equal numbers are drawn here, at the lower edge: zero has no logarithm.
constexpr double least_drawn = 1e-17;

std::vector<PlotPoint> line_of(const Units &units, const Json &speeds, const Json &values,
                               Quantity of) {
    std::vector<PlotPoint> line;
    for (std::size_t i = 0; i < speeds.size(); ++i)
        line.push_back({units(Quantity::speed, speeds[i].get<double>()),
                        times(units.factor(of), item(values, i))});
    return line;
}

/// Curves of a result in its colour.
using Curves = std::vector<ChartCurve>;

Curves campbell_curves(const Units &units, const Comparison &comparison, std::size_t index) {
    const auto &[name, json] = comparison.results[index];
    ChartCurve out = chart_curve(name, {}, index, 2);
    for (const Json &mode : json.at("modes"))
        add_part(out.points,
                 line_of(units, json.at("speeds"), mode.at("frequency"), Quantity::frequency));
    return {out};
}

/// Amplitudes of a station over `speeds`: dense around peaks where the result has them so.
struct StationCurve {
    const Json &speeds;
    const Json &amplitude;
};
StationCurve station_curve(const ComparedResult &result, std::size_t i) {
    const Json &curves = result.json.at("curves");
    if (curves.at("speeds").empty())
        return {result.json.at("speeds"), result.json.at("nodes")[i].at("amplitude")};
    return {curves.at("speeds"), curves.at("nodes")[i].at("amplitude")};
}

std::string station_name(const Units &units, const Json &node) {
    return place_text(units, node.value("name", ""), node.value("z", 0.0));
}

double largest_of(const Json &values) {
    double most = 0;
    for (const Json &value : values)
        most = std::max(most, value.is_number() ? value.get<double>() : 0);
    return most;
}

/// Names of the stations that move most.
std::vector<std::string> stations_of(const Units &units, const ComparedResult &result) {
    const Json &nodes = result.json.at("nodes");
    std::vector<std::pair<double, std::string>> sizes;
    for (std::size_t i = 0; i < nodes.size(); ++i)
        sizes.emplace_back(-largest_of(station_curve(result, i).amplitude),
                           station_name(units, nodes[i]));
    std::sort(sizes.begin(), sizes.end());
    constexpr std::size_t most = 2;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < std::min(sizes.size(), most); ++i)
        names.push_back(sizes[i].second);
    return names;
}

/// Of the stations that move most in the first result, each with a dash of its own; down to a
/// millionth of the largest amplitude, below which there is only the start from rest.
Curves response_curves(const Units &units, const Comparison &comparison, std::size_t index) {
    Curves out;
    const ComparedResult &result = comparison.results[index];
    const Json &nodes = result.json.at("nodes");
    const std::vector<std::string> stations = stations_of(units, comparison.results.front());
    for (std::size_t k = 0; k < stations.size(); ++k)
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            if (station_name(units, nodes[i]) != stations[k])
                continue;
            const StationCurve curve = station_curve(result, i);
            std::vector<PlotPoint> line =
                line_of(units, curve.speeds, curve.amplitude, Quantity::amplitude);
            double largest = 0;
            for (const PlotPoint &point : line)
                largest = std::max(largest, point.y.value_or(0));
            for (PlotPoint &point : line)
                if (point.y && !(*point.y > 1e-6 * largest))
                    point.y.reset();
            out.push_back(chart_curve(fmt::format("{}, {}", result.name, stations[k]),
                                      std::move(line), index, 2, series_style(k).dash));
        }
    return out;
}

/// Over time, of the balancer or the station that moves most in the first result.
Curves motion_curves(const Units &units, const Comparison &comparison, std::size_t index) {
    const auto &[name, json] = comparison.results[index];
    const Json &all = comparison.results.front().json.at("series").at("amplitude");
    std::size_t place = 0;
    for (std::size_t i = 1; i < all.size(); ++i)
        if (largest_of(all[i]) > largest_of(all[place]))
            place = i;
    const Json &series = json.at("series");
    std::vector<PlotPoint> line;
    if (place < series.at("amplitude").size())
        for (std::size_t i = 0; i < series.at("time").size(); ++i)
            line.push_back(
                {series.at("time")[i].get<double>(),
                 times(units.factor(Quantity::amplitude), item(series.at("amplitude")[place], i))});
    return {chart_curve(name, std::move(line), index, 2)};
}

Curves growth_curves(const Units &units, const Comparison &comparison, std::size_t index) {
    const auto &[name, json] = comparison.results[index];
    return {chart_curve(name, line_of(units, json.at("speeds"), json.at("growth"), Quantity::rate),
                        index, 2)};
}

/// A row of marks for each result.
Curves critical_marks(const Units &units, const Comparison &comparison, std::size_t index) {
    const auto &[name, json] = comparison.results[index];
    ChartCurve out{name, {}, series_style(index), 0, 1.5};
    for (const Json &at : json.at("critical_speeds"))
        out.points.push_back(
            {units(Quantity::speed, at.at("speed").get<double>()), -static_cast<double>(index)});
    return {out};
}

/// What a command has above the differences: curves of the index-th result, and what goes upwards.
struct UpperPanel {
    Curves (*curves)(const Units &units, const Comparison &comparison, std::size_t index);
    std::string name;
    Quantity of = Quantity::number;
};
const std::map<std::string, UpperPanel> upper_panels{
    {"campbell", {campbell_curves, "Whirl frequency", Quantity::frequency}},
    {"response", {response_curves, "Amplitude", Quantity::amplitude}},
    {"stability", {growth_curves, "Growth", Quantity::rate}},
    {"simulate", {motion_curves, "Amplitude", Quantity::amplitude}},
    {"critical", {critical_marks, ""}}};

ChartPanel upper_panel(const Units &units, const Comparison &comparison, const UpperPanel &of) {
    ChartPanel panel{385,
                     comparison.command == "simulate"
                         ? chart_axis(units, "Time", Quantity::time)
                         : chart_axis(units, "Spin speed", Quantity::speed),
                     chart_axis(units, of.name, of.of)};
    for (std::size_t i = 0; i < comparison.results.size(); ++i)
        std::ranges::move(of.curves(units, comparison, i), std::back_inserter(panel.curves));
    if (comparison.command == "response")
        span_decades(panel.y, panel.curves, 0);
    if (comparison.command == "critical") {
        panel.height = 155;
        const auto rows = static_cast<int>(comparison.results.size());
        panel.y = {.low = 0.3 - rows, .high = 0.7};
        for (int row = 0; row < rows; ++row)
            panel.y.names.emplace_back(-row, "");
    }
    return panel;
}

/// The number of the last quantity that both have; 0 where they have none in common.
std::size_t last_in_common(const Comparison &comparison) {
    std::size_t last = 0;
    for (const auto &differences : comparison.differences)
        for (std::size_t i = 0; i < differences.size(); ++i)
            if (differences[i].relative)
                last = std::max(last, i + 1);
    return last;
}

ChartPanel lower_panel(const Units &units, const Comparison &comparison) {
    ChartPanel panel{280,
                     {.title = "Quantity, number in the table of its result", .low = 0.3},
                     {.title = "Difference relative to the first"}};
    const auto count = static_cast<double>(last_in_common(comparison));
    panel.x.high = count + 0.7;
    panel.x.step = count < 20 ? 1 : 0;
    for (std::size_t other = 1; other < comparison.results.size(); ++other) {
        const LineStyle style = series_style(other);
        ChartCurve differences{comparison.results[other].name, {}, style, 0, 1.1};
        ChartCurve errors{"both error bars", {}, {"", heavy_colour}, 1};
        double x = 0;
        for (const Difference &at : comparison.differences[other - 1]) {
            ++x;
            if (!at.relative)
                continue;
            differences.points.push_back({x, std::max(least_drawn, std::abs(*at.relative))});
            differences.texts.push_back(
                fmt::format("{}: {:+.3g}", units.text(at.name), *at.relative));
            const double first = std::abs(*at.first_value);
            if (!at.error || first == 0)
                continue;
            const double error = std::max(least_drawn, *at.error / first);
            add_part(errors.points, {{x - 0.32, error}, {x + 0.32, error}});
        }
        panel.curves.push_back(differences);
        if (!errors.points.empty())
            panel.curves.push_back(errors);
    }
    span_decades(panel.y, panel.curves, 0);
    return panel;
}

} // namespace

Chart comparison_chart(const Comparison &comparison, const Units &units) {
    Chart chart{"Comparison: " + comparison.command,
                (comparison.results.size() == 2
                     ? comparison.results[1].name
                     : fmt::format("{} others", comparison.results.size() - 1)) +
                    " against " + comparison.results.front().name,
                {}};
    if (const auto found = upper_panels.find(comparison.command); found != upper_panels.end())
        chart.panels.push_back(upper_panel(units, comparison, found->second));
    if (last_in_common(comparison) == 0)
        chart.subtitle += ": no quantity in common";
    if (last_in_common(comparison) > 0 || chart.panels.empty())
        chart.panels.push_back(lower_panel(units, comparison));
    return chart;
}

} // namespace whirl::report
