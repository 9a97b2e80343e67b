#include "report/pictures/figures.h"

#include "report/common/words.h"
#include "report/pictures/operation.h"
#include "report/pictures/style.h"
#include "results/stability.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace whirl::report {

using results::StabilityResult;

namespace {

using Bands = std::vector<results::Interval>;

const LineStyle unstable_shade{"unstable", "#F4B6C8"};
const LineStyle some_shade{"unstable with some arrangement", "#FBE3EA"};
const LineStyle zero_style{"zero: above it motion grows", "#B0305C", "1"};

/// Bands and lines over the whole height of a panel.
void add_bands(const Units &units, const Bands &bands, const LineStyle &style, ChartPanel &panel) {
    for (const auto &[from, to] : bands)
        panel.curves.push_back(
            upright_band(panel, {units(Quantity::speed, from), units(Quantity::speed, to)}, style));
}
void add_uprights(const Units &units, const std::vector<double> &speeds, const LineStyle &style,
                  ChartPanel &panel) {
    for (const double speed : speeds)
        if (const double at = units(Quantity::speed, speed);
            at >= *panel.x.low && at <= *panel.x.high)
            panel.curves.push_back(upright_line(panel, at, style, 1.5));
}

/// Values at the given speeds, and 0 at the ends of the bands, which are exact: between the speeds
/// the curve leaves zero where they are.
ChartCurve over_speed(const Units &units, const StabilityResult &result,
                      const std::vector<double> &values, const Bands &bands,
                      const LineStyle &style) {
    ChartCurve curve{
        style.name, points_over(result.speeds, units.factor(Quantity::speed), values, 1), style, 2};
    for (const auto &[from, to] : bands)
        for (const double end : {from, to})
            if (end > result.speeds.front() && end < result.speeds.back())
                curve.points.push_back({units(Quantity::speed, end), 0.0});
    std::ranges::stable_sort(curve.points, {}, &PlotPoint::x);
    if (result.speeds.size() == 1) // a point amid its panel
        curve.marker = 1;
    return curve;
}

/// Of values and zero, the border of stability; about values that do not change.
/// @param most  more than that is cut off
Range with_zero(std::vector<double> values, double most = HUGE_VAL) {
    std::erase_if(values, [](double value) { return !std::isfinite(value); });
    for (double &value : values)
        value = std::clamp(value, -most, most);
    const auto [least, largest] = std::ranges::minmax(values.empty() ? std::vector{0.} : values);
    constexpr double rounding = 1e-9;
    const bool flat = largest - least <= rounding * std::max(std::abs(least), std::abs(largest));
    const double low = std::min(least, 0.0);
    const double high = std::max(largest, 0.0);
    const double margin = !flat ? 0.08 * (high - low) : low == high ? 1 : 0.5 * (high - low);
    return {low - margin, high + margin};
}

ChartPanel growth_panel(const model::Case &scene, const Units &units,
                        const StabilityResult &result) {
    ChartPanel panel{345, along_speeds(units, result.speeds),
                     chart_axis(units, "Growth, largest real part", Quantity::rate)};
    std::vector<double> all = result.growth;
    all.insert(all.end(), result.resolved_growth.begin(), result.resolved_growth.end());
    const Range y = with_zero(all);
    panel.y.low = y.low;
    panel.y.high = y.high;
    if (result.family)
        add_bands(units, result.family->unstable, some_shade, panel);
    add_bands(units, result.unstable, unstable_shade, panel);
    add_operation(scene, units, {"", "#5B8C3A", "(6,3)"}, panel); // seen in the bands too
    add_uprights(
        units, result.critical_speeds,
        {scene.rotor.balancers.empty() ? "critical" : "critical, balls held", "#0072B2", "(10,7)"},
        panel);
    add_uprights(units, result.additional_speeds, {"additional speed", "#D55E00", "(12,4,3,4)"},
                 panel);
    panel.curves.push_back(level_line(panel, 0, zero_style, 1.6));
    panel.curves.push_back(
        over_speed(units, result, result.growth, result.unstable, {"growth", "#222222", "1"}));
    if (result.resolved_up_to)
        panel.curves.push_back(
            over_speed(units, result, result.resolved_growth, result.resolved_unstable,
                       {"growth of motions that the elements resolve", "#009E73", "(6,4)"}));
    return panel;
}

/// The smallest logarithmic decrement over the spin speed, below the growth.
ChartPanel log_dec_panel(const Units &units, const StabilityResult &result) {
    constexpr double most = 6.3; // a damping ratio of 0.7
    const Range y = with_zero(result.log_dec, most);
    ChartPanel panel{205,
                     along_speeds(units, result.speeds),
                     {.title = "Least logarithmic decrement", .low = y.low, .high = y.high}};
    add_bands(units, result.unstable, unstable_shade, panel);
    panel.curves.push_back(level_line(panel, 0, {"", zero_style.colour, "1"}, 1.6));
    panel.curves.push_back(
        over_speed(units, result, result.log_dec, result.unstable, {"", "#0072B2", "1"}));
    return panel;
}

/// What is over the arrangements: a row of bars each where there is any.
std::optional<ChartPanel> family_panel(const Units &units, const StabilityResult &result) {
    const results::ArrangementFamily &family = *result.family;
    ChartPanel panel{0, along_speeds(units, result.speeds)};
    const auto row = [&](const std::string &name, const Bands &bands, const char *colour) {
        if (bands.empty())
            return;
        const double at = static_cast<double>(panel.y.names.size()) + 1;
        panel.y.names.emplace_back(at, name);
        for (const auto &[from, to] : bands)
            panel.curves.push_back(
                chart_bar({units(Quantity::speed, from), units(Quantity::speed, to)},
                          {at - 0.3, at + 0.3}, {"", colour}));
    };
    row("additional", family.additional_speeds, "#D55E00");
    row("critical", family.critical_speeds, "#0072B2");
    row("unstable, every", family.always_unstable, "#B0305C");
    row("unstable, some", family.anisotropy.empty() ? Bands{} : family.unstable, "#E58AA6");
    if (panel.y.names.empty())
        return std::nullopt;
    panel.y.low = 0.3;
    panel.y.high = panel.y.names.back().first + 0.7;
    panel.height = 41 * static_cast<int>(panel.y.names.size());
    return panel;
}

/// Quarters of the largest growth, with zero between them, and their colours.
std::vector<ChartLevel> levels_of(const Units &units, const results::StabilityMap &map) {
    double largest = 0;
    for (const std::vector<double> &row : map.growth)
        for (const double growth : row)
            largest = std::max(largest, std::abs(units(Quantity::rate, growth))); // or NaN
    largest = largest > 0 ? largest : 1;
    std::vector<ChartLevel> levels;
    constexpr double tiny = 1e-12;
    const auto edge = [largest](double part) {
        return drawn_number(std::abs(part) > tiny ? part * largest : 0, 3);
    };
    double before = -1;
    for (const auto &[most, colour] : {std::pair(-0.75, "#2166AC"),
                                       {-0.5, "#5A8FC4"},
                                       {-0.25, "#94B8DA"},
                                       {-tiny, "#CDE0EF"},
                                       {tiny, "#D9D9D9"},
                                       {0.25, "#F6CBD8"},
                                       {0.5, "#E397AF"},
                                       {0.75, "#CA6486"},
                                       {1.0, "#B0305C"}}) {
        levels.push_back({most * largest,
                          {most == tiny ? "growth 0"
                                        : fmt::format("growth {} to {} {}", edge(before),
                                                      edge(most), units.name(Quantity::rate)),
                           colour}});
        before = most;
    }
    levels.back().most = HUGE_VAL; // as rounded
    return levels;
}

ChartPanel map_panel(const model::Case &scene, const Units &units,
                     const results::StabilityMap &map) {
    ChartPanel panel{410, along_axis(units, map.x), along_axis(units, map.y)};
    const auto places = [&units](const model::SweepAxis &of) {
        return scaled(of.values, of.is_speed() ? units.factor(of.quantity) : 1);
    };
    std::vector<std::vector<double>> growth;
    for (const std::vector<double> &row : map.growth)
        growth.push_back(scaled(row, units.factor(Quantity::rate)));
    panel.curves = chart_map(places(map.x), places(map.y), growth, levels_of(units, map));
    add_operation(scene, units, {"ends of operating speeds", "#FFC83D", "(9,5)"}, panel);
    panel.x.spin_speed = panel.y.spin_speed =
        false; // behind the map they would show at its sides alone
    return panel;
}

} // namespace

Chart stability_chart(const model::Case &scene, const StabilityResult &result, const Units &units) {
    Chart chart{
        "Stability: " + title_of(scene), "over spin speed", {growth_panel(scene, units, result)}};
    if (std::ranges::any_of(result.log_dec, [](double value) { return std::isfinite(value); }))
        chart.panels.push_back(log_dec_panel(units, result));
    const std::size_t usual = chart.panels.size();
    if (result.family)
        if (auto panel = family_panel(units, result))
            chart.panels.push_back(std::move(*panel));
    if (result.map)
        chart.panels.push_back(map_panel(scene, units, *result.map));
    if (chart.panels.size() > usual)
        chart.subtitle += ", and what the case asks for below";
    return chart;
}

} // namespace whirl::report
