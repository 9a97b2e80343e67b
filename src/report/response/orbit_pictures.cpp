#include "report/response/orbits.h"

#include "report/common/text_width.h"
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
constexpr double cell_width = 250, cell_height = 300; ///< pixels
constexpr double square = 165;
constexpr const char *clearance_colour = "#8A4B00";

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

/// What is said above an orbit.
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
                        : orbit.major > 0 ? 1.15 * orbit.major
                                          : orbit.clearance.value_or(1e-6);
    return 1.12 * units(drawn_as, size);
}

/// @param sign  of the spin speed
std::string orbit_panel(const Units &units, const Orbit &orbit, double sign) {
    const double reach = reach_of(units, orbit);
    const double tic = round_below(0.9 * reach);
    std::string data;
    std::string plots;
    if (orbit.clearance && units(drawn_as, *orbit.clearance) <= reach) {
        data += data_block("c", {circle_points(units(drawn_as, *orbit.clearance))});
        plots += fmt::format("$c with filledcurves closed fs solid 1 noborder fc rgb '#F4F6F8', "
                             "$c with lines lc rgb '{}' lw 1.6 dt (9,5) notitle, ",
                             clearance_colour);
    }
    std::vector<PlotPoint> path;
    for (int k = 0; k <= 120; ++k)
        path.push_back(at_angle(units, orbit, sign * k * pi / 60));
    data += data_block("o", {path}) + data_block("k", {{path.front()}}) +
            data_block("a", {arrow_head(units, orbit, sign, 0.085 * reach)});
    return data +
           fmt::format(
               "set xrange [{0}:{1}]\nset yrange [{0}:{1}]\nset xtics ({2}, 0, {3}) font ',9'\n"
               "set ytics ({2}, 0, {3}) font ',9'\n",
               -reach, reach, -tic, tic) +
           "plot " + plots +
           "$o with lines lc rgb '#0072B2' lw 2 notitle, $a with filledcurves closed fs solid 1 "
           "noborder "
           "fc rgb '#0072B2', $k with points pt 7 ps 0.9 lc rgb '#000000' notitle\nunset label\n";
}

} // namespace

Figure orbits_figure(const model::Case &scene, const std::vector<Orbits> &orbits,
                     const Units &units) {
    const std::vector<std::size_t> drawn = drawn_places(orbits);
    const std::size_t rows = std::min(orbits.size(), most_rows);
    const int width =
        std::max(860, static_cast<int>(90 + cell_width * static_cast<double>(drawn.size())));
    const int height = static_cast<int>(90 + cell_height * static_cast<double>(rows));
    const double high = height;
    const double wide = width;
    std::string panels = std::string("unset key\nset tics scale 0.5\n") + grid;
    for (std::size_t row = 0; row < rows; ++row)
        for (std::size_t column = 0; column < drawn.size(); ++column) {
            const Orbit &orbit = orbits[row].stations[drawn[column]];
            const double left = 95 + cell_width * static_cast<double>(column);
            const double top = 75 + cell_height * static_cast<double>(row);
            const auto label = [&](int number, const std::string &text, double x, double y,
                                   const char *look) {
                return fmt::format("set label {} {} at screen {},{} {}\n", number, plot_text(text),
                                   x / wide, 1 - y / high, look);
            };
            if (column == 0)
                panels +=
                    label(1, "at " + drawn_value(units, Quantity::speed, orbits[row].speed, 6), 20,
                          top + 8, "left font ',12'");
            panels +=
                label(2, fitting(place_text(units, orbit.name, orbit.z), 12.5, cell_width - 20),
                      left + square / 2, top + 32, "center font ',10'") +
                label(3, orbit_words(orbit), left + square / 2, top + 51,
                      "center font ',9' textcolor '#555555'") +
                panel_margins(left / wide, (left + square) / wide, 1 - (top + 64 + square) / high,
                              1 - (top + 64) / high) +
                fmt::format("set xlabel {} font ',9' offset 0,0.5\n{}\n",
                            axis_text(units, "x", drawn_as),
                            column == 0 ? fmt::format("set ylabel {} font ',9' offset 1,0",
                                                      axis_text(units, "y", drawn_as))
                                        : "unset ylabel") +
                orbit_panel(units, orbit, orbits[row].speed < 0 ? -1 : 1);
        }
    return figure_of(
        width, height, "Orbits: " + title_of(scene),
        "disc: Ωt = 0; arrow: the way it is run through; broken circle: radial clearance; in a "
        "bearing against its pedestal",
        panels);
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
