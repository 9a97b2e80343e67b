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

constexpr const char *shade = "#F4B6C8";
constexpr const char *shade_some = "#FBE3EA";
constexpr const char *critical_look = "dt 2 lw 1.3 lc rgb '#0072B2'";
constexpr const char *additional_look = "dt 4 lw 1.3 lc rgb '#D55E00'";

/// Bands over the whole height of a panel, behind everything.
std::string shaded(const Units &units, const Bands &bands, const char *colour) {
    std::string text;
    for (const auto &[from, to] : bands)
        text += fmt::format("set object rectangle from first {},graph 0 to first {},graph 1 behind "
                            "fs solid noborder fc rgb '{}'\n",
                            units(Quantity::speed, from), units(Quantity::speed, to), colour);
    return text;
}

std::string marks(const Units &units, const std::vector<double> &speeds, const char *look) {
    std::string text;
    for (const double speed : speeds)
        text += upright(units(Quantity::speed, speed), look);
    return text;
}

/// One row of bars below the growth: intervals over the arrangements.
std::string bars(const Units &units, const Bands &bands, double row, const char *colour) {
    std::string text;
    for (const auto &[from, to] : bands) // with a line, which shows where the bar is too thin
        text += fmt::format("set object rectangle from first {0},first {1} to first {2},first {3} "
                            "fs solid noborder fc rgb '{4}'\nset arrow from first {0},first {1} "
                            "to first {0},first {3} nohead lw 2 lc rgb '{4}'\n",
                            units(Quantity::speed, from), row - 0.3, units(Quantity::speed, to),
                            row + 0.3, colour);
    return text;
}

/// Growth at the given speeds, and 0 at the ends of the bands, which are exact: between the speeds
/// the curve leaves zero where they are.
std::vector<PlotPoint> growth_points(const Units &units, const StabilityResult &result,
                                     const std::vector<double> &growth, const Bands &bands) {
    std::vector<PlotPoint> points;
    for (std::size_t i = 0; i < result.speeds.size(); ++i)
        points.push_back({units(Quantity::speed, result.speeds[i]), growth[i]});
    for (const auto &[from, to] : bands)
        for (const double end : {from, to})
            if (end > result.speeds.front() && end < result.speeds.back())
                points.push_back({units(Quantity::speed, end), 0.0});
    std::stable_sort(points.begin(), points.end(),
                     [](const PlotPoint &a, const PlotPoint &b) { return a.x < b.x; });
    return points;
}

/// Digits with which numbers at an axis from one value to another differ.
int digits_between(double low, double high) {
    const double largest = std::max(std::abs(low), std::abs(high));
    return std::max(6, 2 + static_cast<int>(std::ceil(std::log10(largest / (high - low)))));
}

/// What is shaded or marked beside the curves, for the key.
void add_growth_keys(const model::Case &scene, const StabilityResult &result, Curves &drawn) {
    if (!result.unstable.empty())
        drawn.add(fmt::format("NaN with boxes fs solid fc rgb '{}' title 'unstable'", shade));
    if (result.family && !result.family->unstable.empty())
        drawn.add(fmt::format(
            "NaN with boxes fs solid fc rgb '{}' title 'unstable with some arrangement'",
            shade_some));
    if (!result.critical_speeds.empty())
        drawn.add(fmt::format("NaN with lines {} title '{}'", critical_look,
                              scene.rotor.balancers.empty() ? "critical" : "critical, balls held"));
    if (!result.additional_speeds.empty())
        drawn.add(fmt::format("NaN with lines {} title 'additional speed'", additional_look));
}

/// Of the axis upwards.
std::string growth_range(const StabilityResult &result) {
    double low = HUGE_VAL; // of the speeds with an answer
    double high = -HUGE_VAL;
    for (const double growth : result.growth)
        if (std::isfinite(growth)) {
            low = std::min(low, growth);
            high = std::max(high, growth);
        }
    if (low > high) // none has
        low = high = 0;
    constexpr double rounding = 1e-9;
    const bool flat = high - low <= rounding * std::max(std::abs(low), std::abs(high));
    const double centre = flat ? low : 0; // of a growth that does not change
    const double reach = centre == 0 ? 1 : 0.5 * std::abs(centre);
    if (!flat) { // zero, the border of stability, is always there
        const double margin = 0.08 * (std::max(high, 0.0) - std::min(low, 0.0));
        std::string range;
        if (high < 0)
            range = fmt::format("set yrange [{}:{}]\n", low - margin, margin);
        else if (low > 0)
            range = fmt::format("set yrange [{}:{}]\n", -margin, high + margin);
        return range + fmt::format("set format y '%.{}g'\n", digits_between(low, high));
    }
    return fmt::format("set yrange [{}:{}]\n", std::min(0.0, centre) - reach,
                       std::max(0.0, centre) + reach);
}

std::string growth_panel(const model::Case &scene, const Units &units,
                         const StabilityResult &result) {
    const bool one = result.speeds.size() == 1; // a point amid its panel
    const Range x = speed_range(units, result.speeds);
    std::string text = operation_band(scene, units, x);
    if (result.family)
        text += shaded(units, result.family->unstable, shade_some);
    text += shaded(units, result.unstable, shade) + operation_edges(scene, units, x) +
            marks(units, result.critical_speeds, critical_look) +
            marks(units, result.additional_speeds, additional_look) +
            fmt::format("set xrange [{}:{}]\n", x.low, x.high) + growth_range(result);
    Curves drawn;
    drawn.add(growth_points(units, result, result.growth, result.unstable),
              fmt::format("with {} lw 2 lc rgb '#222222'", one ? "points pt 7" : "lines"),
              "'growth'");
    if (result.resolved_up_to)
        drawn.add(growth_points(units, result, result.resolved_growth, result.resolved_unstable),
                  fmt::format("with {} lw 2 lc rgb '#009E73'", one ? "points pt 7" : "lines dt 2"),
                  "'growth of motions that the elements resolve'");
    drawn.add("NaN with lines lw 1.6 lc rgb '#B0305C' title 'zero: above it motion grows'");
    add_growth_keys(scene, result, drawn);
    drawn.add(operation_key(scene, units, x));
    return text + grid +
           "set xzeroaxis lt 1 lc rgb '#B0305C' lw 1.6\n"
           "set xlabel " +
           axis_text(units, "Spin speed", Quantity::speed) + "\nset ylabel " +
           axis_text(units, "Growth, largest real part", Quantity::rate) +
           "\n"
           "set key at graph 0,1.02 left bottom horizontal reverse Left samplen 2 maxrows 3\n" +
           drawn.script() +
           "unset label\nunset object\nunset arrow\nunset xzeroaxis\nset autoscale y\n"
           "set format y\n";
}

bool has_log_dec(const StabilityResult &result) {
    return std::ranges::any_of(result.log_dec, [](double value) { return std::isfinite(value); });
}

/// The smallest logarithmic decrement over the spin speed, below the growth.
std::string log_dec_panel(const model::Case &scene, const Units &units,
                          const StabilityResult &result) {
    constexpr double most = 6.3; // a damping ratio of 0.7: more is cut off
    double low = 0;
    double high = 0;
    for (const double value : result.log_dec)
        if (std::isfinite(value)) {
            low = std::min(low, std::max(value, -most));
            high = std::max(high, std::min(value, most));
        }
    const double margin = high > low ? 0.08 * (high - low) : 1;
    Curves drawn;
    drawn.add(growth_points(units, result, result.log_dec, result.unstable),
              fmt::format("with {} lw 2 lc rgb '#0072B2'",
                          result.speeds.size() == 1 ? "points pt 7" : "lines"));
    return operation_band(scene, units, speed_range(units, result.speeds)) +
           shaded(units, result.unstable, shade) +
           fmt::format("set yrange [{}:{}]\nset xzeroaxis lt 1 lc rgb '#B0305C' lw 1.6\n"
                       "set ylabel 'Least logarithmic decrement'\nset xlabel {}\nunset key\n",
                       low - margin, high + margin,
                       axis_text(units, "Spin speed", Quantity::speed)) +
           drawn.script() + "unset object\nunset arrow\nunset xzeroaxis\nset autoscale y\n";
}

/// What is over the arrangements: a row each where there is any.
struct FamilyRow {
    const char *name;
    Bands bands;
    const char *colour;
};

std::vector<FamilyRow> family_rows(const results::ArrangementFamily &family) {
    std::vector<FamilyRow> rows{
        {"additional", family.additional_speeds, "#D55E00"},
        {"critical", family.critical_speeds, "#0072B2"},
        {"unstable, every", family.always_unstable, "#B0305C"},
        {"unstable, some", family.anisotropy.empty() ? Bands{} : family.unstable, "#E58AA6"}};
    std::erase_if(rows, [](const FamilyRow &row) { return row.bands.empty(); });
    return rows;
}

int family_height(const StabilityResult &result) {
    const auto rows = result.family ? family_rows(*result.family).size() : 0;
    return rows == 0 ? 0 : 75 + 41 * static_cast<int>(rows);
}

std::string family_panel(const model::Case &scene, const Units &units,
                         const StabilityResult &result) {
    std::string script = operation_band(scene, units, speed_range(units, result.speeds));
    std::string names;
    int place = 0;
    for (const FamilyRow &row : family_rows(*result.family)) {
        script += bars(units, row.bands, ++place, row.colour);
        names += fmt::format("{}'{}' {}", place > 1 ? ", " : "", row.name, place);
    }
    return script +
           fmt::format("set yrange [0.3:{}]\nset ytics ({})\nunset ylabel\nset xlabel {}\n"
                       "unset key\nplot NaN notitle\nunset object\nunset arrow\nset ytics auto\n"
                       "set autoscale y\n",
                       place + 0.7, names, axis_text(units, "Spin speed", Quantity::speed));
}

std::string axis_title(const Units &units, const model::SweepAxis &axis) {
    return axis.is_speed() ? units.label("Spin speed", Quantity::speed) : axis_name(axis);
}

std::string map_panel(const model::Case &scene, const Units &units,
                      const results::StabilityMap &map) {
    const auto scale = [&](const model::SweepAxis &axis) {
        return axis.is_speed() ? units.factor(Quantity::speed) : 1.0;
    };
    double largest = 0;
    std::string text = "$map << EOD\n";
    for (std::size_t j = 0; j < map.growth.size(); ++j) {
        for (std::size_t i = 0; i < map.growth[j].size(); ++i) {
            largest = std::max(largest, std::abs(map.growth[j][i]));
            text += fmt::format("{} {} {}\n", map.x.values[i] * scale(map.x),
                                map.y.values[j] * scale(map.y), plot_number(map.growth[j][i]));
        }
        text += "\n";
    }
    if (largest == 0)
        largest = 1;
    const auto lines = [&](const model::SweepAxis &of, SpeedAxis axis) {
        const std::vector<double> &at = of.values;
        return of.is_speed() ? operation_lines(scene, units,
                                               {units(Quantity::speed, at.front()),
                                                units(Quantity::speed, at.back())},
                                               axis)
                             : std::string();
    };
    return text + "EOD\n" + lines(map.x, SpeedAxis::x) + lines(map.y, SpeedAxis::y) +
           fmt::format("set xrange [{}:{}]\nset yrange [{}:{}]\nset cbrange [{}:{}]\n"
                       "set palette defined (-1 '#2166AC', -0.001 '#E8F1F8', 0 '#FFFFFF', 0.001 "
                       "'#FBE3EA', 1 '#B0305C')\nset cblabel {}\n"
                       "set xlabel {}\nset ylabel {}\nunset key\nunset grid\nset pm3d map\n"
                       "plot $map using 1:2:3 with image notitle\n",
                       map.x.values.front() * scale(map.x), map.x.values.back() * scale(map.x),
                       map.y.values.front() * scale(map.y), map.y.values.back() * scale(map.y),
                       -largest, largest, axis_text(units, "Growth", Quantity::rate),
                       plot_text(axis_title(units, map.x)), plot_text(axis_title(units, map.y)));
}

} // namespace

Figure stability_figure(const model::Case &scene, const StabilityResult &result,
                        const Units &units) {
    const int family = family_height(result);
    const int log_dec = has_log_dec(result) ? 255 : 0;
    const int height = 545 + log_dec + family + (result.map ? 560 : 0);
    const LegendedFigure room{1180, 0.125, 0.95, height};
    const LegendedFigure beside_palette{1180, 0.125, 0.85, height};
    int bottom = 475;
    std::string panels =
        room.panel(130, bottom) + growth_panel(scene, units, result); // 3 rows of the key
    if (log_dec > 0) {
        panels += room.panel(bottom + 75, bottom + log_dec) + log_dec_panel(scene, units, result);
        bottom += log_dec;
    }
    if (family > 0) {
        panels += room.panel(bottom + 75, bottom + family) + family_panel(scene, units, result);
        bottom += family;
    }
    if (result.map)
        panels +=
            beside_palette.panel(bottom + 95, bottom + 505) + map_panel(scene, units, *result.map);
    return figure_of(1180, height, "Stability: " + title_of(scene),
                     family > 0 || result.map ? "over spin speed, and what the case asks for below"
                                              : "over spin speed",
                     panels);
}

} // namespace whirl::report
