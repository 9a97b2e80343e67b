#include "report/common/column.h"
#include "report/common/words.h"
#include "report/compare/comparison.h"
#include "report/pictures/style.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace whirl::report {

namespace {

/// Differences below this are drawn here: zero has no logarithm.
constexpr double least_drawn = 1e-17;

/// Curves of one result, named in the legend.
struct Overlaid {
    std::string title;
    std::vector<std::vector<PlotPoint>> lines;
};

std::vector<PlotPoint> line_of(const Units &units, const Json &speeds, const Json &values,
                               Quantity of) {
    std::vector<PlotPoint> line;
    for (std::size_t i = 0; i < speeds.size(); ++i)
        line.push_back({units(Quantity::speed, speeds[i].get<double>()),
                        times(units.factor(of), item(values, i))});
    return line;
}

std::vector<Overlaid> campbell_curves(const Units &units, const Comparison &comparison,
                                      std::size_t index) {
    const ComparedResult &result = comparison.results[index];
    Overlaid out{result.name, {}};
    for (const Json &mode : result.json.at("modes"))
        out.lines.push_back(
            line_of(units, result.json.at("speeds"), mode.at("frequency"), Quantity::frequency));
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

/// Of the stations that move most in the first result; down to a millionth of the largest
/// amplitude, below which there is only the start from rest.
std::vector<Overlaid> response_curves(const Units &units, const Comparison &comparison,
                                      std::size_t index) {
    std::vector<Overlaid> out;
    const ComparedResult &result = comparison.results[index];
    const Json &nodes = result.json.at("nodes");
    for (const std::string &station : stations_of(units, comparison.results.front()))
        for (std::size_t i = 0; i < nodes.size(); ++i) {
            if (station_name(units, nodes[i]) != station)
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
            out.push_back({fmt::format("{}, {}", result.name, station), {line}});
        }
    return out;
}

/// Over time, of the balancer or the station that moves most in the first result.
std::vector<Overlaid> motion_curves(const Units &units, const Comparison &comparison,
                                    std::size_t index) {
    const ComparedResult &result = comparison.results[index];
    const Json &all = comparison.results.front().json.at("series").at("amplitude");
    std::size_t place = 0;
    for (std::size_t i = 1; i < all.size(); ++i)
        if (largest_of(all[i]) > largest_of(all[place]))
            place = i;
    const Json &series = result.json.at("series");
    std::vector<PlotPoint> line;
    if (place < series.at("amplitude").size())
        for (std::size_t i = 0; i < series.at("time").size(); ++i)
            line.push_back(
                {series.at("time")[i].get<double>(),
                 times(units.factor(Quantity::amplitude), item(series.at("amplitude")[place], i))});
    return {{result.name, {line}}};
}

std::vector<Overlaid> growth_curves(const Units &units, const Comparison &comparison,
                                    std::size_t index) {
    const ComparedResult &result = comparison.results[index];
    return {{result.name,
             {line_of(units, result.json.at("speeds"), result.json.at("growth"), Quantity::rate)}}};
}

/// A row of marks for each result.
std::vector<Overlaid> critical_marks(const Units &units, const Comparison &comparison,
                                     std::size_t index) {
    Overlaid out{comparison.results[index].name, {}};
    for (const Json &at : comparison.results[index].json.at("critical_speeds"))
        out.lines.push_back(
            {{units(Quantity::speed, at.at("speed").get<double>()), -static_cast<double>(index)}});
    return {out};
}

/// What a command has above the differences: curves of the index-th result, and what goes upwards.
struct UpperPanel {
    std::vector<Overlaid> (*curves)(const Units &units, const Comparison &comparison,
                                    std::size_t index);
    std::string name;
    Quantity of = Quantity::number;
    bool logarithmic = false;
};
const std::map<std::string, UpperPanel> upper_panels{
    {"campbell", {campbell_curves, "Whirl frequency", Quantity::frequency}},
    {"response", {response_curves, "Amplitude", Quantity::amplitude, true}},
    {"stability", {growth_curves, "Growth", Quantity::rate}},
    {"simulate", {motion_curves, "Amplitude", Quantity::amplitude}},
    {"critical", {critical_marks, ""}}};

std::string upper_panel(const Units &units, const Comparison &comparison, double pixel,
                        double bottom, double top) {
    const std::string &command = comparison.command;
    const UpperPanel &panel = upper_panels.at(command);
    const bool marks = command == "critical";
    Curves drawn;
    drawn.add("NaN notitle");
    std::size_t count = 0;
    for (std::size_t i = 0; i < comparison.results.size(); ++i)
        for (const Overlaid &curve : panel.curves(units, comparison, i)) {
            const LineStyle style = series_style(count++);
            drawn.add_pieces(curve.lines,
                             marks ? fmt::format("with points pt {} ps 1.5 lw 1.6 lc rgb '{}'",
                                                 style.point, style.colour)
                                   : line_look(style, 2),
                             plot_text(curve.title));
        }
    return panel_margins(0.09, 0.96, bottom, top) +
           (panel.name.empty() ? "unset ytics\nunset ylabel\n"
                               : "set ylabel " + axis_text(units, panel.name, panel.of) + "\n") +
           (panel.logarithmic ? logarithmic_y : "") +
           (marks ? fmt::format("set yrange [{}:0.7]\n",
                                0.3 - static_cast<double>(comparison.results.size()))
                  : std::string("set autoscale y\n")) +
           fmt::format(
               "set xlabel {}\n{}set key at screen 0.525,{} center center vertical maxrows 4 "
               "samplen 4 font ',10'\n",
               command == "simulate" ? axis_text(units, "Time", Quantity::time)
                                     : axis_text(units, "Spin speed", Quantity::speed),
               grid, 1 - 112 * pixel) +
           drawn.script() + "unset logscale\nset format\nset ytics\nset autoscale\nunset label\n";
}

std::string lower_panel(const Comparison &comparison, double pixel, double bottom, double top) {
    Curves drawn;
    drawn.add("NaN notitle");
    double high = 1e-12;
    for (std::size_t other = 1; other < comparison.results.size(); ++other) {
        std::vector<PlotPoint> differences;
        std::vector<PlotPoint> errors;
        double x = 0;
        for (const Difference &at : comparison.differences[other - 1]) {
            ++x;
            if (!at.relative)
                continue;
            differences.push_back({x, std::max(least_drawn, std::abs(*at.relative))});
            const double first = std::abs(*at.first_value);
            errors.push_back({x, at.error && first > 0
                                     ? std::optional(std::max(least_drawn, *at.error / first))
                                     : std::nullopt});
            high = std::max({high, *differences.back().y, errors.back().y.value_or(0)});
        }
        const LineStyle style = series_style(other);
        drawn.add(
            differences,
            fmt::format("with points pt {} ps 1.1 lw 1.5 lc rgb '{}'", style.point, style.colour),
            plot_text(comparison.results[other].name));
        // A bar is a short line across its number.
        drawn.add(errors,
                  fmt::format("using ($1-0.32):2:(0.64):(0) with vectors nohead lw 1 lc rgb '{}'",
                              style.colour));
    }
    drawn.add("keyentry with lines lw 1 lc rgb '#555555' title 'both error bars'");
    return panel_margins(0.09, 0.96, bottom, top) + logarithmic_y +
           fmt::format("set yrange [{}:{}]\nset xrange [0.3:*]\nset xtics auto\n"
                       "set xlabel 'Quantity, number in the table of its result'\n"
                       "set ylabel 'Difference relative to the first'\n{}"
                       "set key at screen 0.525,{} center center horizontal samplen 2 font ',10'\n",
                       least_drawn / 3, 10 * high, grid, top + 16 * pixel) +
           drawn.script();
}

} // namespace

Figure comparison_figure(const Comparison &comparison, const Units &units) {
    const bool curves = upper_panels.contains(comparison.command);
    const bool marks = comparison.command == "critical";
    const int height = (!curves ? 0 : marks ? 330 : 560) + 430;
    const double pixel = 1.0 / height;
    return figure_of(
        1180, height, "Comparison: " + comparison.command,
        comparison.results.front().name + " against " +
            (comparison.results.size() == 2
                 ? comparison.results[1].name
                 : fmt::format("{} others", comparison.results.size() - 1)),
        (curves ? upper_panel(units, comparison, pixel, (430 + 20) * pixel, 1 - 155 * pixel) : "") +
            lower_panel(comparison, pixel, 60 * pixel, 340 * pixel));
}

} // namespace whirl::report
