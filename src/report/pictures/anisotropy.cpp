#include "report/pictures/figures.h"

#include "report/pictures/style.h"
#include "results/show.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace whirl::report {

namespace {

using results::AnisotropyChart;

const LineStyle unstable_style{"unstable", "#F6D5D0"};
const LineStyle limit_style{"stability limit", "#B00020"};
const LineStyle critical_style{"critical speed", "#0072B2", "(12,5)"};
const LineStyle case_style{"the case", "#444444", "(6,4)"};

/// Speeds in rad/s on the left and in the unit of readers on the right; there alone where it was
/// asked for.
ChartAxis speed_axis(const Units &units, const AnisotropyChart &chart) {
    const bool asked = units.asked(Quantity::speed);
    const Units &own = asked ? units : Units();
    ChartAxis axis{.title = own.label("Spin speed", Quantity::speed),
                   .unit = own.name(Quantity::speed),
                   .low = 0,
                   .high = own(Quantity::speed, chart.speed.back())};
    if (!asked)
        axis.second = {units.label("Spin speed", Quantity::speed), units.factor(Quantity::speed)};
    return axis;
}

/// The region right of the limit curve is unstable.
ChartPanel anisotropy_panel(const Units &units, const AnisotropyChart &chart) {
    const ChartAxis y = speed_axis(units, chart);
    const double factor = *y.high / chart.speed.back();
    ChartPanel panel{
        300,
        {.title = "Anisotropy, half the difference of the diametral inertias / A",
         .low = 0,
         // The case's and the permissible one in its middle.
         .high = std::min(1.0, std::max({2.2 * chart.anisotropy, 3 * chart.permissible, 0.05}))},
        y};
    panel.title = fmt::format("C = {}", drawn_number(chart.C, 4));
    ChartCurve region = chart_area(unstable_style);
    for (std::size_t i = 0; i < chart.speed.size(); ++i)
        region.points.push_back({std::min(chart.limit[i], *panel.x.high), factor * chart.speed[i]});
    region.points.push_back({*panel.x.high, *y.high});
    region.points.push_back({*panel.x.high, 0});
    panel.curves = {
        region,
        {limit_style.name, points_over(chart.limit, 1, chart.speed, factor), limit_style, 2},
        {critical_style.name, points_over(chart.undamped, 1, chart.speed, factor), critical_style},
        upright_line(panel, chart.anisotropy, case_style)};
    return panel;
}

/// Curves over C; a limit or critical speed above the axis leaves it at its upper edge.
ChartPanel polar_inertia_panel(const Units &units, const AnisotropyChart &chart) {
    const ChartAxis y = speed_axis(units, chart);
    const double factor = *y.high / chart.speed.back();
    ChartPanel panel{
        300,
        {.title = "Polar inertia C / A", .low = chart.polar.front(), .high = chart.polar.back()},
        y};
    panel.title = fmt::format("anisotropy {}", drawn_number(chart.anisotropy, 4));
    ChartCurve region = chart_area(unstable_style);
    ChartCurve lower{limit_style.name, {}, limit_style, 2};
    ChartCurve upper = lower;
    ChartCurve first{critical_style.name, {}, critical_style};
    ChartCurve second = first;
    std::vector<PlotPoint> from, to; // of what is unstable side by side
    const auto add = [&from, &to, &region] {
        from.insert(from.end(), to.rbegin(), to.rend());
        if (!from.empty())
            add_part(region.points, from);
        from.clear();
        to.clear();
    };
    for (std::size_t i = 0; i < chart.polar.size(); ++i) {
        const double C = chart.polar[i];
        const auto &band = chart.unstable_over_polar[i];
        const auto &speeds = chart.critical_over_polar[i];
        const auto drawn = [C, factor](std::optional<double> speed) {
            return PlotPoint{C, speed ? std::optional(factor * *speed) : std::nullopt};
        };
        lower.points.push_back(drawn(band ? std::optional(band->from) : std::nullopt));
        upper.points.push_back(drawn(band ? band->to : std::nullopt));
        first.points.push_back(
            drawn(speeds.empty() ? std::nullopt : std::optional(speeds.front())));
        second.points.push_back(
            drawn(speeds.size() < 2 ? std::nullopt : std::optional(speeds.back())));
        if (band && band->from < chart.speed.back()) {
            from.push_back(lower.points.back());
            to.push_back({C, std::min(*y.high, upper.points.back().y.value_or(*y.high))});
        } else {
            add();
        }
    }
    add();
    panel.curves = {region, lower, upper, first, second, upright_line(panel, chart.C, case_style)};
    return panel;
}

} // namespace

Chart anisotropy_chart(const model::Case &scene, const AnisotropyChart &chart, const Units &units) {
    const std::string band =
        !chart.unstable ? "stable at every speed"
        : chart.unstable->to
            ? fmt::format("unstable from {} to {}",
                          drawn_number(units(Quantity::speed, chart.unstable->from)),
                          drawn_value(units, Quantity::speed, *chart.unstable->to))
            : "unstable above " + drawn_value(units, Quantity::speed, chart.unstable->from);
    return {"Critical speeds and stability: " + title_of(scene),
            fmt::format("tilt of the rigid rotor, p = {}, h = {}; {}; stable at every "
                        "speed up to anisotropy {}",
                        drawn_value(units, Quantity::frequency, chart.p),
                        drawn_value(units, Quantity::rate, chart.h), band,
                        drawn_number(chart.permissible)),
            {anisotropy_panel(units, chart), polar_inertia_panel(units, chart)}};
}

} // namespace whirl::report
