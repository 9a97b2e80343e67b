#include "report/pictures/figures.h"

#include "report/pictures/operation.h"
#include "report/pictures/style.h"
#include "results/simulate.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace whirl::report {

using results::SimulateResult;
using results::StationMotion;

namespace {

constexpr std::size_t most_stations = 6; ///< those that move most

/// Two stations whose curves would lie on each other.
bool alike(const StationMotion &a, const StationMotion &b) {
    constexpr double unseen = 1e-4;
    return std::abs(a.peak.value - b.peak.value) <= unseen * a.peak.value &&
           std::abs(a.amplitude - b.amplitude) <= unseen * a.peak.value &&
           std::abs(a.peak.time - b.peak.time) <= unseen * a.peak.time;
}

/// The stations that are drawn, in the order of the shaft.
std::vector<std::size_t> drawn_stations(const SimulateResult &result) {
    std::vector<std::size_t> order(result.stations.size());
    std::iota(order.begin(), order.end(), 0U);
    const std::size_t first = results::largest_station(result.stations);
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        if (a == first || b == first)
            return a == first && b != first;
        return result.stations[a].peak.value > result.stations[b].peak.value;
    });
    std::vector<std::size_t> drawn;
    for (const std::size_t i : order)
        if (drawn.size() < most_stations &&
            std::none_of(drawn.begin(), drawn.end(), [&](std::size_t other) {
                return alike(result.stations[other], result.stations[i]);
            }))
            drawn.push_back(i);
    std::sort(drawn.begin(), drawn.end());
    return drawn;
}

std::string station_name(const Units &units, const StationMotion &station) {
    return place_text(units, station.name, station.z);
}

bool speed_changes(const SimulateResult &result) {
    const auto &speed = result.series.speed;
    return std::any_of(speed.begin(), speed.end(),
                       [&](double value) { return value != speed.front(); });
}

/// Of the index-th station that is drawn.
std::string station_look(std::size_t index, const char *dash, double width) {
    LineStyle style = series_style(index);
    style.dash = dash;
    return line_look(style, width);
}
std::string peak_look(std::size_t index) {
    const LineStyle style = series_style(index);
    return fmt::format("with points lc rgb '{}' pt {} ps 1.1", style.colour, style.point);
}

std::string amplitude_over_time(const Units &units, const SimulateResult &result) {
    Curves lines;
    const std::vector<std::size_t> drawn = drawn_stations(result);
    for (std::size_t i = 0; i < drawn.size(); ++i) {
        const StationMotion &station = result.stations[drawn[i]];
        lines.add(points_over(result.series.time, 1, result.series.amplitude[drawn[i]],
                              units.factor(Quantity::amplitude)),
                  station_look(i, "1", 1.4), plot_text(station_name(units, station)));
        lines.add({{station.peak.time, units(Quantity::amplitude, station.peak.value)}},
                  peak_look(i));
    }
    return axes_beside_legend(units.label("Amplitude", Quantity::amplitude),
                              units.label("Time", Quantity::time)) +
           fmt::format("set xrange [0:{}]\nset yrange [0:*]\n", result.time) + lines.script();
}

/// Linear, or logarithmic where the steady peaks would leave nothing of the motion to see.
std::string amplitude_range(const Units &units, const SimulateResult &result) {
    constexpr double comparable = 4;
    constexpr double decades = 1e-3; ///< of the highest: the least that is drawn
    double steady = 0;
    for (const StationMotion &station : result.stations)
        if (std::isfinite(station.steady_peak.value_or(0)))
            steady = std::max(steady, station.steady_peak.value_or(0));
    const double peak = result.stations[results::largest_station(result.stations)].peak.value;
    if (steady <= comparable * peak)
        return "set yrange [0:*]\n";
    return logarithmic_y +
           fmt::format("set yrange [{}:*]\n", decades * units(Quantity::amplitude, peak));
}

/// The steady response behind, the motion in front.
std::string amplitude_over_speed(const Units &units, const SimulateResult &result) {
    Curves lines;
    const std::vector<std::size_t> drawn = drawn_stations(result);
    for (std::size_t i = 0; i < drawn.size(); ++i) {
        std::vector<PlotPoint> points =
            points_over(result.steady.speeds, units.factor(Quantity::speed),
                        result.steady.amplitudes[drawn[i]], units.factor(Quantity::amplitude));
        const StationMotion &station = result.stations[drawn[i]];
        if (station.steady_peak && std::isfinite(*station.steady_peak)) {
            const double speed = units(Quantity::speed, *station.steady_peak_speed);
            points.insert(std::find_if(points.begin(), points.end(),
                                       [&](const PlotPoint &p) { return p.x > speed; }),
                          {speed, units(Quantity::amplitude, *station.steady_peak)});
        }
        if (!points.empty())
            lines.add(points, station_look(i, "(3,4)", 1),
                      i == 0 ? plot_text("steady (dotted)") : "");
    }
    for (std::size_t i = 0; i < drawn.size(); ++i) {
        const StationMotion &station = result.stations[drawn[i]];
        lines.add(points_over(result.series.speed, units.factor(Quantity::speed),
                              result.series.amplitude[drawn[i]], units.factor(Quantity::amplitude)),
                  station_look(i, "1", 1.4), i == 0 ? plot_text("in this motion") : "");
        lines.add({{units(Quantity::speed, station.peak.speed),
                    units(Quantity::amplitude, station.peak.value)}},
                  peak_look(i), i == 0 ? plot_text("its peak") : "");
    }
    const Range x = speed_range(units, result.series.speed);
    return axes_beside_legend(units.label("Amplitude", Quantity::amplitude),
                              units.label("Spin speed", Quantity::speed)) +
           fmt::format("set xrange [{}:{}]\n", x.low, x.high) + amplitude_range(units, result) +
           lines.script() + linear_y;
}

/// x and y of the station that moves most.
std::string deflection_over_time(const Units &units, const SimulateResult &result) {
    const std::size_t largest = results::largest_station(result.stations);
    Curves lines;
    const std::string of = " at " + station_name(units, result.stations[largest]);
    lines.add(points_over(result.series.time, 1, result.series.x[largest],
                          units.factor(Quantity::deflection)),
              station_look(0, "1", 1), plot_text("x" + of));
    lines.add(points_over(result.series.time, 1, result.series.y[largest],
                          units.factor(Quantity::deflection)),
              station_look(1, "1", 1), plot_text("y" + of));
    return axes_beside_legend(units.label("Deflection", Quantity::deflection),
                              units.label("Time", Quantity::time)) +
           fmt::format("set xrange [0:{}]\nset yrange [*:*]\n", result.time) + lines.script();
}

std::string speed_over_time(const Units &units, const SimulateResult &result) {
    Curves lines;
    lines.add(
        points_over(result.series.time, 1, result.series.speed, units.factor(Quantity::speed)),
        station_look(0, "1", 1.4), plot_text("rotor"));
    return axes_beside_legend(units.label("Speed", Quantity::speed),
                              units.label("Time", Quantity::time)) +
           fmt::format("set xrange [0:{}]\nset yrange [*:*]\n", result.time) + lines.script();
}

} // namespace

Figure stations_figure(const model::Case &scene, const SimulateResult &result, const Units &units) {
    const bool changes = speed_changes(result);
    std::vector<std::string> names;
    for (const StationMotion &station : result.stations)
        names.push_back("x at " + station_name(units, station));
    const LegendedFigure room = beside_legend(821, 1080, changes ? 1010 : 760, names);
    std::string panels =
        grid + room.panel(75, 380) + amplitude_over_time(units, result) + "unset label\n";
    panels += changes ? operation_band(scene, units, speed_range(units, result.series.speed)) +
                            room.panel(445, 750) + amplitude_over_speed(units, result) +
                            "unset object\nunset arrow\n" + room.panel(815, 950) +
                            speed_over_time(units, result)
                      : room.panel(445, 700) + deflection_over_time(units, result);
    return figure_of(room.width, room.height, "Motion in time: " + title_of(scene),
                     fmt::format("{} after {} at {}", results::outcome_name(result.outcome),
                                 drawn_value(units, Quantity::time, result.time),
                                 drawn_value(units, Quantity::speed, result.speed)),
                     panels);
}

} // namespace whirl::report
