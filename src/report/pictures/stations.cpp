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

std::string station_name(const StationMotion &station) {
    return place_text(station.name, station.z);
}

bool speed_changes(const SimulateResult &result) {
    const auto &speed = result.series.speed;
    return std::any_of(speed.begin(), speed.end(),
                       [&](double value) { return value != speed.front(); });
}

/// Lines of one panel, collected: data blocks and elements of the plot command.
class Lines {
  public:
    explicit Lines(std::string panel) : _panel(std::move(panel)) {}

    void add(const std::vector<PlotPoint> &points, const std::string &look,
             const std::string &title) {
        const std::string name = fmt::format("{}{}", _panel, _count++);
        _data += data_block(name, {points});
        _plots += fmt::format("{}${} {} {}", _plots.empty() ? "plot " : ", ", name, look,
                              title.empty() ? "notitle" : "title " + plot_text(title));
    }
    [[nodiscard]] std::string text() const {
        return _data + (_plots.empty() ? "plot NaN notitle" : _plots) + "\n";
    }

  private:
    std::string _panel;
    std::string _data;
    std::string _plots;
    int _count = 0;
};

std::string line_look(std::size_t index, const char *dash, double width) {
    return fmt::format("with lines lc rgb '{}' lw {} dt {}", series_style(index).colour, width,
                       dash);
}
std::string peak_look(std::size_t index) {
    const LineStyle style = series_style(index);
    return fmt::format("with points lc rgb '{}' pt {} ps 1.1", style.colour, style.point);
}

LegendedFigure room_of(const SimulateResult &result) {
    std::vector<std::string> names;
    for (const StationMotion &station : result.stations)
        names.push_back("x at " + station_name(station));
    return beside_legend(92, 821, 1080, names);
}

std::string panel_of(const Figure &figure, const LegendedFigure &room, int top, int bottom) {
    const double pixel = 1.0 / figure.height;
    return panel_margins(room.left, room.right, 1 - bottom * pixel, 1 - top * pixel);
}

std::string station_axes(const std::string &label, const std::string &below) {
    return fmt::format("set ylabel {}\nset xlabel {}\nset key at graph 1.02,1 left top reverse "
                       "Left vertical samplen 3\n",
                       plot_text(label), plot_text(below));
}

std::string amplitude_over_time(const SimulateResult &result) {
    Lines lines("t");
    const std::vector<std::size_t> drawn = drawn_stations(result);
    for (std::size_t i = 0; i < drawn.size(); ++i) {
        const StationMotion &station = result.stations[drawn[i]];
        std::vector<PlotPoint> points;
        for (std::size_t k = 0; k < result.series.time.size(); ++k)
            points.push_back(
                {result.series.time[k], result.series.amplitude[drawn[i]][k] * micrometres});
        lines.add(points, line_look(i, "1", 1.4), station_name(station));
        lines.add({{station.peak.time, station.peak.value * micrometres}}, peak_look(i), "");
    }
    return station_axes("Amplitude (µm)", "Time (s)") +
           fmt::format("set xrange [0:{}]\nset yrange [0:*]\n", result.time) + lines.text();
}

/// Linear, or logarithmic where the steady peaks would leave nothing of the motion to see.
std::string amplitude_range(const SimulateResult &result) {
    constexpr double comparable = 4;
    constexpr double decades = 1e-3; ///< of the highest: the least that is drawn
    double steady = 0;
    for (const StationMotion &station : result.stations)
        if (std::isfinite(station.steady_peak.value_or(0)))
            steady = std::max(steady, station.steady_peak.value_or(0));
    const double peak = result.stations[results::largest_station(result.stations)].peak.value;
    if (steady <= comparable * peak)
        return "set yrange [0:*]\n";
    return fmt::format("set logscale y\nset format y '10^{{%L}}'\nset yrange [{}:*]\n",
                       decades * peak * micrometres);
}

/// The steady response behind, the motion in front.
std::string amplitude_over_speed(const SimulateResult &result) {
    Lines lines("s");
    const std::vector<std::size_t> drawn = drawn_stations(result);
    for (std::size_t i = 0; i < drawn.size(); ++i) {
        std::vector<PlotPoint> points;
        for (std::size_t k = 0; k < result.steady.speeds.size(); ++k) {
            const double value = result.steady.amplitudes[drawn[i]][k];
            points.push_back(
                {result.steady.speeds[k] * rpm,
                 std::isfinite(value) ? std::optional(value * micrometres) : std::nullopt});
        }
        const StationMotion &station = result.stations[drawn[i]];
        if (station.steady_peak && std::isfinite(*station.steady_peak)) {
            const double speed = *station.steady_peak_speed * rpm;
            points.insert(std::find_if(points.begin(), points.end(),
                                       [&](const PlotPoint &p) { return p.x > speed; }),
                          {speed, *station.steady_peak * micrometres});
        }
        if (!points.empty())
            lines.add(points, line_look(i, "(3,4)", 1), i == 0 ? "steady (dashed)" : "");
    }
    for (std::size_t i = 0; i < drawn.size(); ++i) {
        const StationMotion &station = result.stations[drawn[i]];
        std::vector<PlotPoint> points;
        for (std::size_t k = 0; k < result.series.time.size(); ++k)
            points.push_back(
                {result.series.speed[k] * rpm, result.series.amplitude[drawn[i]][k] * micrometres});
        lines.add(points, line_look(i, "1", 1.4), i == 0 ? "in this motion" : "");
        lines.add({{station.peak.speed * rpm, station.peak.value * micrometres}}, peak_look(i),
                  i == 0 ? "its peak" : "");
    }
    const auto [low, high] =
        std::minmax_element(result.series.speed.begin(), result.series.speed.end());
    return station_axes("Amplitude (µm)", "Spin speed (rpm)") +
           fmt::format("set xrange [{}:{}]\n", *low * rpm, *high * rpm) + amplitude_range(result) +
           lines.text() + "unset logscale y\nset format y '%g'\n";
}

/// x and y of the station that moves most.
std::string deflection_over_time(const SimulateResult &result) {
    const std::size_t largest = results::largest_station(result.stations);
    Lines lines("d");
    for (const auto &[name, values] :
         {std::pair("x", &result.series.x[largest]), std::pair("y", &result.series.y[largest])}) {
        std::vector<PlotPoint> points;
        for (std::size_t k = 0; k < values->size(); ++k)
            points.push_back({result.series.time[k], (*values)[k] * micrometres});
        lines.add(points, line_look(name == std::string("x") ? 0 : 1, "1", 1),
                  fmt::format("{} at {}", name, station_name(result.stations[largest])));
    }
    return station_axes("Deflection (µm)", "Time (s)") +
           fmt::format("set xrange [0:{}]\nset yrange [*:*]\n", result.time) + lines.text();
}

std::string speed_over_time(const SimulateResult &result) {
    Lines lines("n");
    std::vector<PlotPoint> points;
    for (std::size_t k = 0; k < result.series.time.size(); ++k)
        points.push_back({result.series.time[k], result.series.speed[k] * rpm});
    lines.add(points, line_look(0, "1", 1.4), "rotor");
    return station_axes("Speed (rpm)", "Time (s)") +
           fmt::format("set xrange [0:{}]\nset yrange [*:*]\n", result.time) + lines.text();
}

} // namespace

Figure stations_figure(const model::Case &scene, const SimulateResult &result) {
    const bool changes = speed_changes(result);
    const LegendedFigure room = room_of(result);
    Figure figure;
    figure.width = room.width;
    figure.height = changes ? 1010 : 760;
    figure.script =
        figure_head("Motion in time: " + title_of(scene),
                    fmt::format("{} after {} s at {} rpm", results::outcome_name(result.outcome),
                                readable(result.time), readable(result.speed * rpm)),
                    figure.height) +
        "set grid lc rgb '#E4E4E4' lt 1 lw 0.6\n" + panel_of(figure, room, 75, 380) +
        amplitude_over_time(result) + "unset label\n";
    if (changes) {
        const auto [low, high] =
            std::minmax_element(result.series.speed.begin(), result.series.speed.end());
        figure.script += operation_band(scene, {*low * rpm, *high * rpm}) +
                         panel_of(figure, room, 445, 750) + amplitude_over_speed(result) +
                         "unset object\nunset arrow\n" + panel_of(figure, room, 815, 950) +
                         speed_over_time(result);
    } else {
        figure.script += panel_of(figure, room, 445, 700) + deflection_over_time(result);
    }
    figure.script += "unset multiplot\n";
    return figure;
}

} // namespace whirl::report
