#include "report/response/parts.h"

#include "report/common/words.h"
#include "report/pictures/shaft_outline.h"
#include "report/pictures/style.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace whirl::report {

using results::DeflectedShape;
using results::Orbit;
using results::Orbits;

namespace {

constexpr std::size_t most_rows = 6; ///< speeds that are drawn
constexpr std::size_t most_supports = 4;

/// Places whose orbits are drawn, in the order of the shaft: bearings and seals, those with a
/// clearance first, and the station that moves most at any of the speeds.
std::vector<std::size_t> drawn_places(const std::vector<Orbits> &orbits) {
    const std::vector<Orbit> &places = orbits.front().stations;
    std::vector<std::size_t> drawn;
    for (const bool with_clearance : {true, false})
        for (std::size_t i = 0; i < places.size(); ++i)
            if (places[i].of != "station" && places[i].clearance.has_value() == with_clearance &&
                drawn.size() < most_supports)
                drawn.push_back(i);
    std::size_t largest = 0;
    double most = 0;
    for (const Orbits &at : orbits)
        for (std::size_t i = 0; i < at.stations.size(); ++i)
            if (at.stations[i].major > most * (1 + 1e-9)) {
                most = at.stations[i].major;
                largest = i;
            }
    if (std::find(drawn.begin(), drawn.end(), largest) == drawn.end())
        drawn.push_back(largest);
    std::stable_sort(drawn.begin(), drawn.end(),
                     [&](std::size_t a, std::size_t b) { return places[a].z < places[b].z; });
    return drawn;
}

/// The largest of 1, 2, 5 times a power of ten that is not above a value.
double round_below(double value) {
    const double power = std::pow(10, std::floor(std::log10(value)));
    return value >= 5 * power ? 5 * power : value >= 2 * power ? 2 * power : power;
}

/// Deflections here are never from peak to peak: a clearance stands beside them.
constexpr Quantity drawn_as = Quantity::deflection;

PlotPoint at_angle(const Units &units, const Orbit &orbit, double angle) {
    return {units(drawn_as, orbit.x * std::cos(angle + orbit.x_phase)),
            units(drawn_as, orbit.y * std::cos(angle + orbit.y_phase))};
}

/// A quarter of a turn after the phase mark, the way the orbit is run through.
std::vector<PlotPoint> arrow_head(const Units &units, const Orbit &orbit, double sign,
                                  double size) {
    constexpr double step = 1e-3; // of a turn
    const PlotPoint before = at_angle(units, orbit, sign * (pi / 2 - step));
    const PlotPoint there = at_angle(units, orbit, sign * (pi / 2 + step));
    const double dx = there.x - before.x;
    const double dy = *there.y - *before.y;
    const double length = std::hypot(dx, dy);
    if (length == 0)
        return {{there.x, std::nullopt}};
    const double ex = size * dx / length;
    const double ey = size * dy / length;
    const PlotPoint tip{there.x + ex, *there.y + ey};
    return {tip,
            {there.x - ex - 0.8 * ey, *there.y - ey + 0.8 * ex},
            {there.x - ex + 0.8 * ey, *there.y - ey - 0.8 * ex},
            tip};
}

/// What is said in the corner of the panel of an orbit.
std::string orbit_words(const Orbit &orbit) {
    if (const auto share = orbit.share())
        return fmt::format("{:.3g} % of the clearance", *share * 100);
    return orbit.of == "station" ? "" : "no clearance given";
}

/// Half of the side of a panel: the clearance circle where the orbit can be seen in it.
double reach_of(const Units &units, const Orbit &orbit) {
    constexpr double seen = 0.25;
    const double share = orbit.share().value_or(0);
    const double size = share >= seen     ? std::max(orbit.major, *orbit.clearance)
                        : orbit.major > 0 ? 1.08 * orbit.major
                                          : orbit.clearance.value_or(1e-6);
    return 1.2 * units(drawn_as, size); // with room for words above a circle
}

/// @param sign  of the spin speed
ChartPanel orbit_panel(const Units &units, const Orbit &orbit, double sign) {
    constexpr int side = 240; // pixels
    constexpr const char *blue = "#0072B2";
    ChartPanel panel{side, chart_axis(units, "x", drawn_as), chart_axis(units, "y", drawn_as)};
    panel.square = true;
    panel.title = place_text(units, orbit.name, orbit.z);
    const double reach = reach_of(units, orbit);
    const double tick = round_below(0.9 * reach);
    for (ChartAxis *axis : {&panel.x, &panel.y}) {
        axis->low = -reach;
        axis->high = reach;
        for (const double at : {-tick, 0.0, tick})
            axis->names.emplace_back(at, drawn_number(at));
    }
    if (orbit.clearance && units(drawn_as, *orbit.clearance) <= reach) {
        const auto circle = circle_points(units(drawn_as, *orbit.clearance));
        panel.curves = {chart_area({"", "#F4F6F8"}, circle),
                        {"radial clearance", circle, {"", "#8A4B00", "(9,5)"}, 1.6}};
    }
    ChartCurve path{"orbit", {}, {"", blue}, 2};
    for (int k = 0; k <= 120; ++k)
        path.points.push_back(at_angle(units, orbit, sign * k * pi / 60));
    panel.curves.insert(panel.curves.end(),
                        {path,
                         chart_area({"", blue}, arrow_head(units, orbit, sign, 0.065 * reach)),
                         ChartCurve{"at Ωt = 0", {path.points.front()}, {"", "#000000"}, 0, 0.9}});
    if (const std::string words = orbit_words(orbit); !words.empty())
        panel.labels = {{words, -reach, reach, "#555555"}};
    return panel;
}

} // namespace

Chart orbits_chart(const model::Case &scene, const std::vector<Orbits> &orbits,
                   const Units &units) {
    Chart chart{"Orbits: " + title_of(scene),
                "arrow: the way it is run through; in a bearing against its pedestal",
                {}};
    const std::vector<std::size_t> drawn = drawn_places(orbits);
    for (std::size_t row = 0; row < std::min(orbits.size(), most_rows); ++row)
        for (const std::size_t place : drawn) {
            const double speed = orbits[row].speed;
            ChartPanel &panel = chart.panels.emplace_back(
                orbit_panel(units, orbits[row].stations[place], speed < 0 ? -1 : 1));
            panel.beside = place != drawn.front();
            if (panel.beside)
                panel.y.title.clear();
            else
                panel.title = fmt::format(
                    "at {} · {}", drawn_value(units, Quantity::speed, speed, 6), panel.title);
        }
    return chart;
}

Chart shapes_chart(const model::Case &scene, const std::vector<DeflectedShape> &shapes,
                   const Units &units) {
    Chart chart{"Deflected shapes: " + title_of(scene),
                "at the instant of the largest deflection, with the envelope of the orbits; the "
                "outline of the rotor is not to that scale",
                {}};
    for (std::size_t row = 0; row < std::min(shapes.size(), most_rows); ++row) {
        const DeflectedShape &shape = shapes[row];
        const double largest = shape.largest > 0 ? units(drawn_as, shape.largest) : 1;
        ChartPanel panel{185, along_shaft(units, scene.rotor),
                         chart_axis(units, "Deflection", drawn_as),
                         curves_over_outline(units, scene.rotor, shape.z, shape.x, shape.y,
                                             shape.envelope, units.factor(drawn_as), largest)};
        panel.y.low = -1.25 * largest;
        panel.y.high = 1.25 * largest;
        panel.title = fmt::format("at {} · largest {} at z = {}",
                                  drawn_value(units, Quantity::speed, shape.speed, 6),
                                  drawn_value(units, drawn_as, shape.largest, 4),
                                  drawn_value(units, Quantity::length, shape.largest_z, 4));
        chart.panels.push_back(std::move(panel));
    }
    return chart;
}

} // namespace whirl::report
