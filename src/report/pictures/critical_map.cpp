#include "report/pictures/figures.h"

#include "report/critical_map.h"
#include "report/pictures/labels.h"
#include "report/pictures/operation.h"
#include "report/pictures/style.h"
#include "results/critical.h"
#include "results/whirl.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace whirl::report {

using results::CriticalMap;
using results::CriticalMapBearing;
using results::CriticalMapCurve;
using results::Whirl;

namespace {

constexpr double map_left = 0.085;
constexpr double map_right = 0.955;

/// Speeds of the map with room above and below on a logarithmic axis.
Range map_speeds(const Units &units, const CriticalMap &map) {
    double low = HUGE_VAL;
    double high = 0;
    for (const CriticalMapCurve &curve : map.curves)
        for (const double speed : curve.speed)
            if (speed > 0) {
                low = std::min(low, units(Quantity::speed, speed));
                high = std::max(high, units(Quantity::speed, speed));
            }
    return high > 0 ? Range{low / 1.3, high * 1.3} : Range{1, 10};
}

/// The place of a value on a logarithmic axis, 0 to 1.
double along(double value, Range range) {
    return std::log(value / range.low) / std::log(range.high / range.low);
}

std::string bearing_words(const model::Case &scene, const Units &units,
                          const CriticalMapBearing &across) {
    const std::size_t count = across.bearings.size();
    if (count <= 2)
        return bearings_text(scene, across.bearings, units);
    return fmt::format("{} and {} more", bearings_text(scene, {across.bearings.front()}, units),
                       count - 1);
}

/// The stiffness of a bearing over speed: kxx full, kyy broken.
void add_bearings(const model::Case &scene, const Units &units, const CriticalMap &map,
                  Curves &drawn) {
    for (std::size_t i = 0; i < map.bearings.size(); ++i) {
        const CriticalMapBearing &across = map.bearings[i];
        LineStyle style = series_style(i + 2); // the first two are those of whirl
        for (const bool x : {true, false}) {
            if (!x && across.isotropic)
                continue;
            std::vector<PlotPoint> points =
                points_over(x ? across.kxx : across.kyy, units.factor(Quantity::stiffness),
                            across.speeds, units.factor(Quantity::speed));
            for (PlotPoint &point : points)
                if (!(point.x > 0)) // outside of what a logarithmic axis shows: the line ends
                    point = {1, std::nullopt};
            style.dash = x ? "1" : "(3,4)";
            drawn.add(points, line_look(style, 2),
                      plot_text(fmt::format("{}, {}", coefficient_name(across, x),
                                            bearing_words(scene, units, across))));
        }
    }
}

/// Names of the curves at their stiff ends, apart from one another.
std::string curve_labels(const Units &units, const CriticalMap &map, Range y) {
    std::vector<double> wanted;
    for (const CriticalMapCurve &curve : map.curves)
        wanted.push_back(
            curve.speed.back() > 0 ? along(units(Quantity::speed, curve.speed.back()), y) : -1);
    const auto places = spread(wanted, 0.036, {0.02, 0.98});
    std::string labels;
    for (std::size_t i = 0; i < map.curves.size(); ++i)
        if (wanted[i] >= 0)
            labels += fmt::format("set label '{}' at graph 1.008,graph {:.5g} left font ',10' "
                                  "textcolor '{}'\n",
                                  curve_name(map.curves[i].whirl, map.curves[i].number), places[i],
                                  whirl_style(map.curves[i].whirl).colour);
    return labels;
}

/// Up to where a critical speed matters for a machine that runs (API 617, of its maximum continuous
/// speed).
constexpr double of_interest = 1.26;

/// Crossings of forward motions, up to the speeds of interest where the case says how fast the
/// machine runs; the table has the others too.
std::vector<PlotPoint> drawn_crossings(const model::Case &scene, const Units &units,
                                       const CriticalMap &map) {
    const double highest = scene.operation ? of_interest * scene.operation->to : HUGE_VAL;
    std::vector<PlotPoint> drawn;
    for (const auto &at : map.crossings)
        if (at.whirl == Whirl::forward && at.speed <= highest)
            drawn.push_back(
                {units(Quantity::stiffness, at.stiffness), units(Quantity::speed, at.speed)});
    return drawn;
}

/// Crossings as circles with their speeds, where there is room for these, and lines that lead to
/// them.
std::string crossing_marks(const std::vector<PlotPoint> &crossings, Range x, Range y) {
    LabelPlacer placer;
    for (const PlotPoint &at : crossings)
        placer.block({along(at.x, x) - 0.006, along(*at.y, y) - 0.012, 0.012, 0.024});
    std::string labels;
    for (std::size_t i = 0; i < crossings.size(); ++i) {
        const double u = along(crossings[i].x, x);
        const double v = along(*crossings[i].y, y);
        const std::string speed = drawn_number(*crossings[i].y);
        constexpr double letter = 0.0072; // of this font, of the panel
        const auto box =
            placer.place(u, v, letter * static_cast<double>(speed.size()) + 0.006, 0.032);
        if (box)
            labels +=
                fmt::format("set label '{}' at graph {:.5g},graph {:.5g} center font ',10' front\n",
                            speed, box->x + box->width / 2, box->y + box->height / 2) +
                leader(*box, u, v);
    }
    return labels;
}

std::string map_panel(const model::Case &scene, const Units &units, const CriticalMap &map,
                      double pixel) {
    const Range x{units(Quantity::stiffness, map.stiffness.front()),
                  units(Quantity::stiffness, map.stiffness.back())};
    const Range y = map_speeds(units, map);
    Curves drawn;
    for (std::size_t i = 0; i < map.curves.size(); ++i) {
        const CriticalMapCurve &curve = map.curves[i];
        const LineStyle style = whirl_style(curve.whirl);
        const bool first = i == 0 || map.curves[i - 1].whirl != curve.whirl;
        drawn.add(points_over(map.stiffness, units.factor(Quantity::stiffness), curve.speed,
                              units.factor(Quantity::speed)),
                  line_look(style, curve.whirl == Whirl::forward ? 2 : 0.8),
                  first ? "'" + style.name + "'" : "");
    }
    if (map.curves.empty())
        drawn.add("NaN notitle");
    add_bearings(scene, units, map, drawn);
    drawn.add(operation_key(scene, units, y));
    const std::vector<PlotPoint> crossings = drawn_crossings(scene, units, map);
    if (!crossings.empty())
        drawn.add(crossings, "with points pt 6 ps 1.2 lw 1.4 lc rgb '#000000'",
                  "'forward crossing, its speed'");
    return panel_margins(map_left, map_right, 330 * pixel, 1 - 112 * pixel) + axes_over(x, y) +
           fmt::format("set logscale xy\nset format x '10^{{%L}}'\nset format y '{}'\n"
                       "set xlabel {}\nset ylabel {}\n{}"
                       "set key at screen 0.5,{} center center horizontal samplen 3 font ',10'\n",
                       y.high < 1e6 ? "%g" : "10^{%L}",
                       axis_text(units, "Stiffness of the supports", Quantity::stiffness),
                       axis_text(units, "Critical speed", Quantity::speed), grid, 1 - 84 * pixel) +
           operation_band(scene, units, y, SpeedAxis::y) + curve_labels(units, map, y) +
           crossing_marks(crossings, x, y) + drawn.script() +
           "unset label\nunset object\nunset arrow\nunset logscale\nset format\n";
}

/// Deflections of the lowest forward motions at one end of the map.
std::string shape_panel(const model::Case &scene, const Units &units, const CriticalMap &map,
                        bool soft, double pixel) {
    constexpr std::size_t most = 4;
    Curves drawn;
    std::size_t count = 0;
    for (const CriticalMapCurve &curve : map.curves) {
        const std::vector<double> &shape = soft ? curve.soft : curve.stiff;
        if (curve.whirl != Whirl::forward || shape.empty() || count == most)
            continue;
        drawn.add(points_over(map.z, units.factor(Quantity::length), shape, 1),
                  line_look(series_style(count++), 2),
                  plot_text(fmt::format("{}, {}", curve_name(curve.whirl, curve.number),
                                        drawn_value(units, Quantity::speed,
                                                    soft ? curve.speed.front() : curve.speed.back(),
                                                    6))));
    }
    std::vector<PlotPoint> bearings;
    for (const auto &bearing : scene.rotor.supports())
        bearings.push_back({units(Quantity::length, bearing.z), -1.12});
    drawn.add(bearings, "with points pt 9 ps 1.4 lc rgb '#555555'");
    const double length =
        units(Quantity::length, std::max(map.z.empty() ? 1 : map.z.back(), 1e-12));
    const double left = soft ? map_left : 0.54;
    return panel_margins(left, left + 0.415, 60 * pixel, 186 * pixel) +
           axes_over({-0.03 * length, 1.03 * length}, {-1.25, 1.25}) +
           fmt::format("set title {} font ',12' offset 0,1.3\nset ytics -1,1,1\n"
                       "set xlabel {}\nset ylabel ''\n"
                       "set key at screen {},{} center center horizontal samplen 2.5 font ',10'\n",
                       plot_text(fmt::format(
                           "Shapes at the {} end, {}", soft ? "soft" : "stiff",
                           drawn_value(units, Quantity::stiffness,
                                       soft ? map.stiffness.front() : map.stiffness.back(), 4))),
                       axis_text(units, "z", Quantity::length), left + 0.2075, 204 * pixel) +
           drawn.script();
}

} // namespace

Figure critical_map_figure(const model::Case &scene, const CriticalMap &map, const Units &units) {
    constexpr int height = 960;
    constexpr double pixel = 1.0 / height;
    return figure_of(1200, height, "Critical speed map: " + title_of(scene),
                     "undamped critical speeds over the stiffness of " +
                         (map.bearing ? bearings_text(scene, {*map.bearing}, units)
                                      : std::string("all bearings together")),
                     map_panel(scene, units, map, pixel) +
                         shape_panel(scene, units, map, true, pixel) +
                         shape_panel(scene, units, map, false, pixel));
}

} // namespace whirl::report
