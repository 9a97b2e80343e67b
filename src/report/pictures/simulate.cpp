#include "results/simulate.h"
#include "report/pictures/chart.h"
#include "report/pictures/figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace whirl::report {

using results::MotionSeries;
using results::SimulateResult;
using results::StationMotion;

namespace {

constexpr std::size_t most_angles = 16; ///< beyond, on the page alone
constexpr const char *dotted = "(3,4)";

/// Mean speed between output times over that of the rotor.
std::vector<PlotPoint> relative_speed(const MotionSeries &series,
                                      const std::vector<double> &angles) {
    std::vector<PlotPoint> points;
    for (std::size_t k = 1; k < series.time.size(); ++k) {
        const double span = series.time[k] - series.time[k - 1];
        const double speed = series.speed[k];
        if (speed != 0)
            points.push_back({series.time[k], 1 + (angles[k] - angles[k - 1]) / (span * speed)});
    }
    return points;
}

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

/// One of the lists over time, in its unit.
std::vector<PlotPoint> over_time(const Units &units, const SimulateResult &result,
                                 const std::vector<double> &values, Quantity quantity) {
    return points_over(result.series.time, 1, values, units.factor(quantity));
}

ChartAxis time_axis(const Units &units, const SimulateResult &result) {
    ChartAxis axis = chart_axis(units, "Time", Quantity::time);
    axis.low = 0;
    axis.high = result.time;
    return axis;
}

ChartPanel speed_panel(const Units &units, const SimulateResult &result) {
    return {140,
            time_axis(units, result),
            chart_axis(units, "Speed", Quantity::speed),
            {chart_curve("rotor", over_time(units, result, result.series.speed, Quantity::speed), 0,
                         1.4, "1")}};
}

/// Amplitudes at the balancers, from one start and from others, and without balls.
ChartPanel balancer_panel(const Units &units, const SimulateResult &result) {
    ChartPanel panel{
        325, time_axis(units, result), chart_axis(units, "Amplitude", Quantity::amplitude), {}};
    const auto add = [&](const std::string &name, const std::vector<double> &amplitude) {
        std::vector<PlotPoint> points = over_time(units, result, amplitude, Quantity::amplitude);
        points.erase(points.begin(), points.begin() + (points.empty() ? 0 : 1)); // at rest: nothing
        panel.curves.push_back(chart_curve(name, points, panel.curves.size(), 1.4, "1"));
    };
    for (std::size_t i = 0; i < result.balancers.size(); ++i)
        add(place_text(units, result.balancers[i].name, result.balancers[i].z),
            result.series.amplitude[i]);
    for (std::size_t i = 0; i < result.other_starts.size(); ++i)
        add(fmt::format("start {}: {}", i + 2,
                        results::outcome_name(result.other_starts[i].outcome)),
            result.other_starts[i].amplitude);
    for (std::size_t i = 0; i < result.balancers.size(); ++i)
        if (const results::BalancerMotion &b = result.balancers[i]; b.reference > 0) {
            const double held = units(Quantity::amplitude, b.reference);
            panel.curves.push_back(chart_curve(
                result.balancers.size() > 1 ? "without balls, " + place_text(units, b.name, b.z)
                                            : "without balls",
                {{0, held}, {result.time, held}}, i, 1, dotted));
        }
    span_decades(panel.y, panel.curves, 1e-6);
    return panel;
}

/// Angles of balls or pendulums in the rotor; of balls that lag their speed over that of the rotor.
ChartPanel angle_panel(const Units &units, const SimulateResult &result) {
    const bool lagging = result.outcome == results::Outcome::lagging;
    ChartPanel panel{285,
                     time_axis(units, result),
                     lagging ? ChartAxis{.title = "Ball speed / rotor speed"}
                             : phase_axis(units, "Angle in the rotor"),
                     {}};
    for (std::size_t i = 0; i < result.balancers.size(); ++i)
        for (std::size_t j = 0; j < result.balancers[i].angles.size(); ++j) {
            const std::size_t number = panel.curves.size();
            const std::vector<double> &angles = result.series.angles[number];
            const results::BalancerMotion &balancer = result.balancers[i];
            const std::string of =
                balancer.name.empty() ? "balancer " + std::to_string(i + 1) : balancer.name;
            panel.curves.push_back(chart_curve(balancer.coordinates.at(j) +
                                                   (result.balancers.size() > 1 ? ", " + of : ""),
                                               lagging ? relative_speed(result.series, angles)
                                                       : angles_over(result.series.time, 1, angles),
                                               number, 1.4, "1"));
            panel.curves.back().on_page = number >= most_angles;
        }
    return panel;
}

/// The stations in the order in which they are drawn, the first ones in still pictures too.
struct DrawnStations {
    std::vector<std::size_t> all;
    std::size_t still = 0;
};
DrawnStations ordered_stations(const SimulateResult &result) {
    DrawnStations out{drawn_stations(result), 0};
    out.still = out.all.size();
    for (std::size_t i = 0; i < result.stations.size(); ++i)
        if (std::ranges::find(out.all, i) == out.all.end())
            out.all.push_back(i);
    return out;
}

/// A curve of the index-th of them; a point without a line is a peak.
void add_station(ChartPanel &panel, const DrawnStations &drawn, std::size_t index,
                 const std::string &name, std::vector<PlotPoint> points, double width,
                 const std::string &dash) {
    panel.curves.push_back(chart_curve(name, std::move(points), index, width, dash));
    panel.curves.back().marker = width > 0 ? 0 : 1.1;
    panel.curves.back().on_page = index >= drawn.still;
}

/// Amplitudes of the stations, with their peaks.
ChartPanel station_panel(const Units &units, const SimulateResult &result,
                         const DrawnStations &drawn) {
    ChartPanel panel{
        305, time_axis(units, result), chart_axis(units, "Amplitude", Quantity::amplitude), {}};
    panel.y.low = 0;
    for (std::size_t i = 0; i < drawn.all.size(); ++i) {
        const StationMotion &station = result.stations[drawn.all[i]];
        add_station(
            panel, drawn, i, station_name(units, station),
            over_time(units, result, result.series.amplitude[drawn.all[i]], Quantity::amplitude),
            1.4, "1");
        add_station(panel, drawn, i, "",
                    {{station.peak.time, units(Quantity::amplitude, station.peak.value)}}, 0, "");
    }
    return panel;
}

/// The steady response behind, the motion in front; logarithmic where the steady peaks would leave
/// nothing of the motion to see.
ChartPanel amplitude_over_speed(const Units &units, const SimulateResult &result,
                                const DrawnStations &drawn) {
    constexpr double comparable = 4;
    constexpr double decades = 1e-3; ///< of the highest: the least that is drawn
    const double speed = units.factor(Quantity::speed);
    const double amplitude = units.factor(Quantity::amplitude);
    ChartPanel panel{305, along_speeds(units, result.series.speed),
                     chart_axis(units, "Amplitude", Quantity::amplitude)};
    double steady = 0;
    for (std::size_t i = 0; i < drawn.all.size(); ++i) {
        std::vector<PlotPoint> points = points_over(
            result.steady.speeds, speed, result.steady.amplitudes[drawn.all[i]], amplitude);
        const StationMotion &station = result.stations[drawn.all[i]];
        if (station.steady_peak && std::isfinite(*station.steady_peak)) {
            const double at = speed * *station.steady_peak_speed;
            steady = std::max(steady, *station.steady_peak);
            points.insert(std::find_if(points.begin(), points.end(),
                                       [&](const PlotPoint &p) { return p.x > at; }),
                          {at, amplitude * *station.steady_peak});
        }
        if (!points.empty())
            add_station(panel, drawn, i, i == 0 ? "steady (dotted)" : "", points, 1, dotted);
    }
    for (std::size_t i = 0; i < drawn.all.size(); ++i) {
        const StationMotion &station = result.stations[drawn.all[i]];
        add_station(panel, drawn, i, i == 0 ? "in this motion" : "",
                    points_over(result.series.speed, speed, result.series.amplitude[drawn.all[i]],
                                amplitude),
                    1.4, "1");
        add_station(panel, drawn, i, i == 0 ? "its peak" : "",
                    {{speed * station.peak.speed, amplitude * station.peak.value}}, 0, "");
    }
    const double peak = result.stations[results::largest_station(result.stations)].peak.value;
    panel.y.logarithmic = steady > comparable * peak;
    panel.y.low = panel.y.logarithmic ? decades * amplitude * peak : 0;
    return panel;
}

/// x and y of the station that moves most.
ChartPanel deflection_panel(const Units &units, const SimulateResult &result) {
    const std::size_t most = results::largest_station(result.stations);
    const std::string of = " at " + station_name(units, result.stations[most]);
    return {255,
            time_axis(units, result),
            chart_axis(units, "Deflection", Quantity::deflection),
            {chart_curve("x" + of,
                         over_time(units, result, result.series.x[most], Quantity::deflection), 0,
                         1, "1"),
             chart_curve("y" + of,
                         over_time(units, result, result.series.y[most], Quantity::deflection), 1,
                         1, "1")}};
}

} // namespace

Chart simulate_chart(const model::Case &scene, const SimulateResult &result, const Units &units) {
    Chart chart{"Motion in time: " + title_of(scene), "", {}};
    const bool changes = speed_changes(result);
    const std::string outcome = results::outcome_name(result.outcome);
    const std::string speed = drawn_value(units, Quantity::speed, result.speed);
    if (result.balancers.empty()) {
        const DrawnStations drawn = ordered_stations(result);
        chart.subtitle = fmt::format("{} after {} at {}", outcome,
                                     drawn_value(units, Quantity::time, result.time), speed);
        chart.panels = {station_panel(units, result, drawn),
                        changes ? amplitude_over_speed(units, result, drawn)
                                : deflection_panel(units, result)};
    } else {
        chart.subtitle = fmt::format("outcome: {}, at the end {}", outcome, speed);
        chart.panels = {balancer_panel(units, result), angle_panel(units, result)};
    }
    if (changes)
        chart.panels.push_back(speed_panel(units, result));
    return chart;
}

} // namespace whirl::report
