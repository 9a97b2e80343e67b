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

constexpr int panel_size = 400; // pixels
constexpr int panel_gap = 60;
constexpr int head_height = 90;
constexpr int curves_height = 380;
constexpr std::size_t most_speeds = 3; ///< with a panel of readings each

/// A round number at or above a value.
double round_above(double value) {
    if (!(value > 0) || !std::isfinite(value))
        return 1;
    const double power = std::pow(10, std::floor(std::log10(value)));
    for (const double digit : {1.0, 1.2, 1.6, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0})
        if (digit * power >= value * (1 - 1e-9))
            return digit * power;
    return 10 * power;
}

PlotPoint point_of(std::complex<double> value, double factor) {
    return {factor * value.real(), factor * value.imag()};
}

/// Circles, axes and their numbers up to a radius; angles as they are in the case.
std::string polar_axes(double radius, const std::string &unit) {
    std::string script =
        fmt::format("unset border\nunset tics\nunset xlabel\nunset ylabel\nunset logscale\n"
                    "set xrange [{0}:{1}]\nset yrange [{0}:{1}]\n",
                    -1.12 * radius, 1.12 * radius);
    for (const int share : {1, 2})
        script += fmt::format(
            "set label '{}' at first {},first {} left font ',10' textcolor '#777777'\n",
            share == 2 ? drawn_number(radius, 3) + " " + unit : drawn_number(radius / 2, 3),
            0.03 * radius, (0.5 * share + 0.045) * radius);
    for (const auto &[text, x, y, where] : {std::tuple("0°", 1.03, 0.04, "left"),
                                            {"90°", -0.03, 1.05, "right"},
                                            {"180°", -1.03, 0.04, "right"},
                                            {"270°", -0.03, -1.07, "right"}})
        script += fmt::format("set label '{}' at first {},first {} {} font ',10' textcolor "
                              "'#777777'\n",
                              text, x * radius, y * radius, where);
    return script;
}

void add_grid(Curves &curves, double radius) {
    const char *look = "with lines lc rgb '#DDDDDD' lw 0.8";
    curves.add_pieces({circle_points(radius),
                       circle_points(radius / 2),
                       {{-radius, 0.0}, {radius, 0.0}},
                       {{0.0, -radius}, {0.0, radius}}},
                      look);
}

std::string panel_title(const std::string &title) {
    return "set title " + plot_text(title) + " offset 0,-0.6\n";
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
std::string readings_panel(const Units &units, const WeightsResult &result,
                           const std::optional<double> &speed, bool legend) {
    const double factor = units.factor(Quantity::amplitude);
    const std::vector<std::string> names = names_of_probes(result);
    double largest = 0;
    for (const results::WeightReading &reading : result.residual)
        if (reading.speed == speed)
            largest = std::max({largest, std::abs(reading.before), std::abs(reading.after)});
    const double radius = round_above(factor * largest);
    Curves curves;
    add_grid(curves, radius);
    for (const results::WeightReading &reading : result.residual) {
        if (reading.speed != speed)
            continue;
        const auto place = static_cast<std::size_t>(
            std::find(names.begin(), names.end(), reading.probe) - names.begin());
        const LineStyle style = series_style(place);
        const PlotPoint before = point_of(reading.before, factor);
        const PlotPoint after = point_of(reading.after, factor);
        curves.add({before, after}, fmt::format("with lines lw 1.2 lc rgb '{}'", style.colour));
        curves.add({before},
                   fmt::format("with points pt 6 ps 1.3 lw 1.6 lc rgb '{}'", style.colour));
        curves.add({after}, fmt::format("with points pt 7 ps 1.1 lc rgb '{}'", style.colour),
                   legend ? plot_text(reading.probe) : "");
    }
    return polar_axes(radius, units.name(Quantity::amplitude)) +
           panel_title(speed ? "Readings at " + drawn_value(units, Quantity::speed, *speed)
                             : "Readings") +
           (legend ? "set key at screen 0.995,screen 0.9 right top Left reverse samplen 1 "
                     "font ',11' maxrows 14\n"
                   : "unset key\n") +
           curves.script() + "unset label\nunset title\n";
}

std::string weights_panel(const Units &units, const WeightsResult &result) {
    const double factor = units.factor(Quantity::imbalance);
    double largest = 0;
    for (const results::CorrectionWeight &weight : result.weights)
        largest = std::max(largest, std::abs(weight.weight));
    const double radius = round_above(factor * largest);
    Curves curves;
    add_grid(curves, radius);
    std::string labels;
    for (std::size_t i = 0; i < result.weights.size(); ++i) {
        const results::CorrectionWeight &weight = result.weights[i];
        const LineStyle style = series_style(i);
        const PlotPoint tip = point_of(weight.weight, factor);
        curves.add({{0, 0.0}, tip}, fmt::format("with lines lw 2 lc rgb '{}'", style.colour));
        curves.add({tip}, fmt::format("with points pt 7 ps 1.3 lc rgb '{}'", style.colour));
        if (weight.scatter) {
            std::vector<PlotPoint> circle = circle_points(factor * *weight.scatter);
            for (PlotPoint &point : circle)
                point = {point.x + tip.x, *point.y + *tip.y};
            curves.add(circle, fmt::format("with lines lw 0.8 dt (4,4) lc rgb '{}'", style.colour));
        }
        labels += fmt::format("set label {} at first {},first {} {} offset {},0.4 font ',11' "
                              "textcolor '{}' front\n",
                              plot_text(weight.plane), tip.x, *tip.y, tip.x < 0 ? "right" : "left",
                              tip.x < 0 ? -0.8 : 0.8, style.colour);
    }
    return polar_axes(radius, units.name(Quantity::imbalance)) + labels +
           panel_title("Weights to add") + "unset key\n" + curves.script() +
           "unset label\nunset title\n";
}

std::string curves_panel(const Units &units, const WeightsResult &result) {
    Curves curves;
    const double speed = units.factor(Quantity::speed);
    const double amplitude = units.factor(Quantity::amplitude);
    const auto points = [&](const std::vector<std::optional<double>> &values) {
        std::vector<PlotPoint> line;
        for (std::size_t i = 0; i < values.size(); ++i)
            if (values[i] && *values[i] > 0) // zero has no logarithm
                line.push_back({speed * result.curve_speeds[i], amplitude * *values[i]});
            else
                line.push_back({speed * result.curve_speeds[i], std::nullopt});
        return line;
    };
    for (std::size_t i = 0; i < result.curves.size(); ++i) {
        const LineStyle style = series_style(i);
        curves.add(points(result.curves[i].before),
                   fmt::format("with lines lw 1.1 dt (5,4) lc rgb '{}'", style.colour));
        curves.add(points(result.curves[i].after),
                   fmt::format("with lines lw 2 lc rgb '{}'", style.colour));
    }
    std::string marks;
    for (const std::optional<double> &own : speeds_of(result))
        if (own)
            marks += upright(speed * *own, "back lw 1 dt (8,4) lc rgb '#999999'");
    const Range x = speed_range(units, result.curve_speeds);
    return fmt::format("set border\nset tics\nset autoscale y\nset xrange [{}:{}]\n", x.low,
                       x.high) +
           logarithmic_y + grid + marks + "set xlabel " +
           axis_text(units, "Spin speed", Quantity::speed) + "\nset ylabel " +
           axis_text(units, "Amplitude", Quantity::amplitude) + "\nunset key\n" + curves.script();
}

} // namespace

Figure weights_figure(const model::Case &scene, const WeightsResult &result, const Units &units) {
    const std::vector<std::optional<double>> speeds = speeds_of(result);
    const std::size_t shown = std::min(speeds.size(), most_speeds);
    const bool curves = !result.curves.empty();
    const int legend = static_cast<int>(widest_text(names_of_probes(result))) + 60;
    const int width = static_cast<int>(shown + 1) * (panel_size + panel_gap) + panel_gap + legend;
    const int polar_bottom = head_height + panel_size + 20;
    const int height = polar_bottom + (curves ? curves_height : 20);
    const double pixel_x = 1.0 / width, pixel_y = 1.0 / height;
    const auto margins = [&](std::size_t place) {
        const double left = panel_gap + static_cast<double>(place) * (panel_size + panel_gap);
        return panel_margins(left * pixel_x, (left + panel_size) * pixel_x,
                             1 - (head_height + panel_size) * pixel_y, 1 - head_height * pixel_y);
    };
    std::string panels;
    for (std::size_t i = 0; i < shown; ++i)
        panels += margins(i) + readings_panel(units, result, speeds[i], i == 0);
    panels += margins(shown) + weights_panel(units, result);
    if (curves)
        panels += panel_margins(100 * pixel_x, (width - panel_gap - legend) * pixel_x, 70 * pixel_y,
                                1 - (polar_bottom + 30) * pixel_y) +
                  curves_panel(units, result);
    std::string subtitle = "open marks: before, filled: after; angles are the phases of the case";
    if (shown < speeds.size())
        subtitle += fmt::format("; {} of {} speeds", shown, speeds.size());
    if (curves)
        subtitle += "; below dashed: before";
    return figure_of(width, height, "Correction weights: " + title_of(scene), subtitle, panels);
}

} // namespace whirl::report
