#include "report/pictures/figures.h"

#include "report/critical_map.h"
#include "report/pictures/chart.h"
#include "report/pictures/shaft_outline.h"
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
                  ChartPanel &panel) {
    for (std::size_t i = 0; i < map.bearings.size(); ++i) {
        const CriticalMapBearing &across = map.bearings[i];
        for (const bool x : {true, false}) {
            if (!x && across.isotropic)
                continue;
            std::vector<PlotPoint> points =
                points_over(x ? across.kxx : across.kyy, units.factor(Quantity::stiffness),
                            across.speeds, units.factor(Quantity::speed));
            for (PlotPoint &point : points)
                if (!(point.x > 0)) // outside of what a logarithmic axis shows: the line ends
                    point = {1, std::nullopt};
            panel.curves.push_back(chart_curve(fmt::format("{}, {}", coefficient_name(across, x),
                                                           bearing_words(scene, units, across)),
                                               points, i + 2, 2,
                                               x ? "1" : "(3,4)")); // the first two are of whirl
        }
    }
}

/// Up to where a critical speed matters for a machine that runs (API 617, of its maximum continuous
/// speed).
constexpr double of_interest = 1.26;

/// Crossings of forward motions with their speeds, up to the speeds of interest where the case says
/// how fast the machine runs; the table has the others too.
void add_crossings(const model::Case &scene, const Units &units, const CriticalMap &map,
                   ChartPanel &panel) {
    const double highest = scene.operation ? of_interest * scene.operation->to : HUGE_VAL;
    ChartCurve circles{"forward crossing, its speed", {}, {"", "#000000", "1", 6}, 0, 1.2};
    for (const auto &at : map.crossings) {
        if (at.whirl != Whirl::forward || at.speed > highest)
            continue;
        const double x = units(Quantity::stiffness, at.stiffness);
        const double y = units(Quantity::speed, at.speed);
        circles.points.push_back({x, y});
        panel.labels.push_back({drawn_number(y), x, y});
    }
    if (!circles.points.empty())
        panel.curves.push_back(std::move(circles));
}

ChartPanel map_panel(const model::Case &scene, const Units &units, const CriticalMap &map) {
    ChartPanel panel{520,
                     chart_axis(units, "Stiffness of the supports", Quantity::stiffness,
                                map.stiffness.front(), map.stiffness.back()),
                     chart_axis(units, "Critical speed", Quantity::speed),
                     {}};
    const Range y = map_speeds(units, map);
    panel.x.logarithmic = panel.y.logarithmic = true;
    panel.y.low = y.low;
    panel.y.high = y.high;
    for (const CriticalMapCurve &curve : map.curves) {
        const LineStyle style = whirl_style(curve.whirl);
        panel.curves.push_back({style.name,
                                points_over(map.stiffness, units.factor(Quantity::stiffness),
                                            curve.speed, units.factor(Quantity::speed)),
                                style, curve.whirl == Whirl::forward ? 2 : 0.8});
        if (curve.speed.back() > 0)
            panel.ends.push_back({curve_name(curve.whirl, curve.number), *panel.x.high,
                                  units(Quantity::speed, curve.speed.back()), style.colour});
    }
    add_bearings(scene, units, map, panel);
    add_crossings(scene, units, map, panel);
    return panel;
}

/// Deflections of the lowest forward motions at one end of the map.
ChartPanel shape_panel(const model::Case &scene, const Units &units, const CriticalMap &map,
                       bool soft) {
    constexpr std::size_t most = 4;
    const double length = std::max(map.z.empty() ? 1 : map.z.back(), 1e-12);
    ChartPanel panel{126,
                     chart_axis(units, "z", Quantity::length, -0.03 * length, 1.03 * length),
                     {.low = -1.25, .high = 1.25, .step = 1},
                     {}};
    panel.title = fmt::format("Shapes at the {} end, {}", soft ? "soft" : "stiff",
                              drawn_value(units, Quantity::stiffness,
                                          soft ? map.stiffness.front() : map.stiffness.back(), 4));
    for (const CriticalMapCurve &curve : map.curves) {
        const std::vector<double> &shape = soft ? curve.soft : curve.stiff;
        if (curve.whirl != Whirl::forward || shape.empty() || panel.curves.size() == most)
            continue;
        panel.curves.push_back(chart_curve(
            fmt::format("{}, {}", curve_name(curve.whirl, curve.number),
                        drawn_value(units, Quantity::speed,
                                    soft ? curve.speed.front() : curve.speed.back(), 6)),
            points_over(map.z, units.factor(Quantity::length), shape, 1), panel.curves.size(), 2));
    }
    panel.curves.push_back(bearings_below(units, scene.rotor, "", 1));
    return panel;
}

} // namespace

Chart critical_map_chart(const model::Case &scene, const CriticalMap &map, const Units &units) {
    return {"Critical speed map: " + title_of(scene),
            "undamped critical speeds over the stiffness of " +
                (map.bearing ? bearings_text(scene, {*map.bearing}, units)
                             : std::string("all bearings together")),
            {map_panel(scene, units, map), shape_panel(scene, units, map, true),
             shape_panel(scene, units, map, false)}};
}

} // namespace whirl::report
