#include "report/pictures/figures.h"

#include "report/pictures/operation.h"
#include "report/pictures/style.h"
#include "report/response/marks.h"
#include "results/response.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace whirl::report {

using results::ResponseResult;

namespace {

constexpr std::size_t most_curves = 8;

/// A curve of a panel: its name in the legend and its values over the speeds.
struct Curve {
    std::string name;
    std::vector<PlotPoint> points;
};

std::vector<std::string> names_of(const std::vector<Curve> &curves,
                                  const std::vector<Curve> &others) {
    std::vector<std::string> names{"operating speeds"};
    for (const std::vector<Curve> *list : {&curves, &others})
        for (const Curve &curve : *list)
            names.push_back(curve.name);
    return names;
}

std::vector<PlotPoint> over_speed(const std::vector<double> &speeds,
                                  const std::vector<double> &values, double factor) {
    std::vector<PlotPoint> points;
    for (std::size_t i = 0; i < speeds.size() && i < values.size(); ++i) {
        // A logarithmic axis has no place for zero, the response at rest.
        const bool drawn = std::isfinite(values[i]) && values[i] > 0;
        points.push_back(
            {speeds[i] * rpm, drawn ? std::optional(values[i] * factor) : std::nullopt});
    }
    return points;
}

/// Phase in degrees within (-180, 180], cut where it jumps from one end to the other.
std::vector<PlotPoint> phase_points(const std::vector<double> &speeds,
                                    const std::vector<double> &phase) {
    std::vector<PlotPoint> points;
    for (std::size_t i = 0; i < speeds.size() && i < phase.size(); ++i) {
        if (!std::isfinite(phase[i])) { // none at a resonance without damping
            points.push_back({speeds[i] * rpm, std::nullopt});
            continue;
        }
        const double degrees = std::remainder(phase[i], 2 * pi) * 180 / pi;
        if (!points.empty() && points.back().y && std::abs(degrees - *points.back().y) > 180)
            points.push_back({speeds[i] * rpm, std::nullopt});
        points.push_back({speeds[i] * rpm, degrees});
    }
    return points;
}

/// @param further  entries of the legend, each after a comma
std::string draw(const std::string &panel, const std::vector<Curve> &curves, bool legend,
                 const std::string &further = "") {
    Curves drawn(panel);
    for (std::size_t i = 0; i < curves.size(); ++i) {
        const LineStyle style = series_style(i);
        const std::size_t step = std::max<std::size_t>(1, curves[i].points.size() / 9);
        drawn.add(
            curves[i].points,
            fmt::format("with linespoints lc rgb '{}' lw 1.8 dt {} pt {} ps 0.8 pointinterval {}",
                        style.colour, style.dash, style.point, step),
            legend ? plot_text(curves[i].name) : "");
    }
    return drawn.script(further);
}

/// Logarithmic axis over the curves, at most three powers of ten down from the largest value of the
/// smallest of them and six from that of all, so that the start from rest does not squeeze the
/// peaks; with room for the names of these.
Range logarithmic_range(const std::vector<Curve> &curves) {
    double high = 0;
    double low = HUGE_VAL;
    double smallest = HUGE_VAL; // of the largest values
    for (const Curve &curve : curves) {
        double largest = 0;
        for (const PlotPoint &point : curve.points)
            if (point.y) {
                largest = std::max(largest, *point.y);
                low = std::min(low, *point.y);
            }
        high = std::max(high, largest);
        if (largest > 0)
            smallest = std::min(smallest, largest);
    }
    if (high <= 0)
        high = low = smallest = 1;
    low = std::max({low, 1e-3 * smallest, 1e-6 * high});
    const double power = std::pow(10, std::floor(std::log10(high)) + 1);
    return {std::pow(10, std::floor(std::log10(low))), high > 0.5 * power ? 2 * power : power};
}

std::string logarithmic_axis(const std::vector<Curve> &curves) {
    const Range y = logarithmic_range(curves);
    return logarithmic_y + fmt::format("set ytics auto\nset yrange [{}:{}]\n", y.low, y.high);
}

/// rpm
Range speed_axis(const ResponseResult &result) {
    const Range x = range_of(result.speeds);
    return {x.low * rpm, x.high * rpm};
}

std::string panel_axes(const ResponseResult &result, const std::string &label, bool last) {
    const Range x = speed_axis(result);
    return fmt::format("set xrange [{}:{}]\nset ylabel {}\n{}\n{}", x.low, x.high, plot_text(label),
                       last ? "set xlabel 'Spin speed (rpm)'" : "unset xlabel", legend_beside);
}

/// At most `count` of a list, evenly spread, with its first and last.
std::vector<std::size_t> spread_over(const std::vector<std::size_t> &list, std::size_t count) {
    if (list.size() <= count)
        return list;
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < count; ++i)
        chosen.push_back(list[count < 2 ? 0 : i * (list.size() - 1) / (count - 1)]);
    return chosen;
}

/// Of all places, or of many those with names first, filled up with others.
template <class Place> std::vector<std::size_t> drawn_of(const std::vector<Place> &places) {
    std::vector<std::size_t> named;
    std::vector<std::size_t> others;
    for (std::size_t i = 0; i < places.size(); ++i)
        (places[i].name.empty() ? others : named).push_back(i);
    std::vector<std::size_t> chosen = spread_over(named, most_curves);
    const auto more = spread_over(others, most_curves - chosen.size());
    chosen.insert(chosen.end(), more.begin(), more.end());
    std::sort(chosen.begin(), chosen.end());
    return chosen;
}

} // namespace

std::vector<std::size_t> drawn_nodes(const ResponseResult &result) {
    std::vector<std::size_t> drawn = drawn_of(result.nodes);
    const auto largest = largest_station(result);
    if (!largest || std::find(drawn.begin(), drawn.end(), *largest) != drawn.end())
        return drawn;
    // Never without the largest: in place of its neighbour among those that are drawn.
    const auto far = [&](std::size_t i) { return std::max(i, *largest) - std::min(i, *largest); };
    *std::min_element(drawn.begin(), drawn.end(),
                      [&](std::size_t a, std::size_t b) { return far(a) < far(b); }) = *largest;
    std::sort(drawn.begin(), drawn.end());
    return drawn;
}

namespace {

struct Panels {
    std::vector<Curve> amplitude, phase, force;
    std::size_t nodes = 0; ///< curves of nodes among the amplitudes
};

/// The values at the speeds of the case, or those of the i-th dense curve where there is one.
std::vector<PlotPoint> dense(const results::ResponseCurves &curves, std::size_t i,
                             const std::vector<double> &speeds, const std::vector<double> &values,
                             double factor) {
    return i < curves.values.size() ? over_speed(curves.speeds, curves.values[i], factor)
                                    : over_speed(speeds, values, factor);
}

std::string name_or(const std::string &name, const char *kind) {
    return name.empty() ? kind : name;
}

Panels panels_of(const ResponseResult &result) {
    Panels panels;
    std::vector<Curve> &amplitude = panels.amplitude;
    const results::ResponseCurves &curves = result.curves;
    const auto add = [&](std::size_t i, const std::string &name, const auto &of) {
        amplitude.push_back({name, dense(curves, i, result.speeds, of.amplitude, micrometres)});
        const bool fine = i < curves.values.size();
        panels.phase.push_back({"", phase_points(fine ? curves.speeds : result.speeds,
                                                 fine ? curves.phases[i] : of.phase)});
    };
    for (const std::size_t i : drawn_nodes(result))
        add(i, place_text(result.nodes[i].name, result.nodes[i].z), result.nodes[i]);
    panels.nodes = amplitude.size();
    for (std::size_t i = 0; i < result.probes.size() && amplitude.size() < 2 * most_curves; ++i) {
        const auto &probe = result.probes[i];
        add(result.nodes.size() + result.bearings.size() + i,
            fmt::format("{} at {}°", place_text(name_or(probe.name, "probe"), probe.z),
                        readable(probe.angle * 180 / pi, 4)),
            probe);
    }
    for (std::size_t i = 0; i < result.bearings.size() && i < most_curves; ++i) {
        const auto &bearing = result.bearings[i];
        panels.force.push_back(
            {place_text(name_or(bearing.name, "bearing"), bearing.z),
             dense(curves, result.nodes.size() + i, result.speeds, bearing.force, newtons)});
    }
    return panels;
}

} // namespace

Figure response_figure(const model::Case &scene, const ResponseResult &result) {
    const auto [amplitude, phase, force, nodes] = panels_of(result);
    const Range x = speed_axis(result);
    std::vector<std::string> names = names_of(amplitude, force);
    PeakMarks marks;
    if (const auto largest = largest_station(result)) {
        std::vector<std::vector<PlotPoint>> busy;
        for (const Curve &curve : amplitude)
            busy.push_back(curve.points);
        marks = peak_marks(result, *largest, {x, logarithmic_range(amplitude), 750, 355}, busy);
        names.push_back("peaks of " +
                        place_text(result.nodes[*largest].name, result.nodes[*largest].z));
    }
    LegendedFigure room = beside_legend(92, 842, 1080, names);
    room.height = force.empty() ? 780 : 1040;
    std::string panels =
        grid + operation_band(scene, x) + logarithmic_axis(amplitude) + room.panel(75, 430) +
        panel_axes(result, "Amplitude (µm)", false) + marks.before +
        draw("a", amplitude, true, marks.plots + operation_key(scene, x)) + marks.after +
        "unset label\n" + linear_y + "set yrange [-190:190]\nset ytics 90\n" +
        room.panel(460, 700) +
        panel_axes(result,
                   result.probes.empty() ? "Phase of x (deg)" : "Phase of x, of a probe (deg)",
                   force.empty()) +
        draw("p", phase, false);
    if (!force.empty())
        panels += logarithmic_axis(force) + room.panel(730, 975) +
                  panel_axes(result, "Largest bearing force (N)", true) + draw("f", force, true);
    return figure_of(room.width, room.height, "Unbalance response: " + title_of(scene),
                     fmt::format("{} stations drawn of {}", nodes, result.nodes.size()), panels);
}

namespace {

std::string gravity_subtitle(const results::GravityResponse &of, std::size_t drawn) {
    return fmt::format("gravity {} m/s² towards −y, {} stations drawn of {}",
                       readable(of.gravity, 5), drawn, of.stations.size());
}

/// A shaft that is equally stiff in all directions: it stands still in its sag.
Figure sag_figure(const model::Case &scene, const ResponseResult &result) {
    const results::GravityResponse &of = *result.gravity;
    std::vector<Curve> still;
    for (const std::size_t i : drawn_of(of.stations)) {
        const auto &station = of.stations[i];
        still.push_back({place_text(station.name, station.z),
                         over_speed(result.speeds, station.sag, still_micrometres)});
    }
    LegendedFigure room = beside_legend(92, 842, 1080, names_of(still, {}));
    room.height = 500;
    const Range x = speed_axis(result);
    return figure_of(room.width, room.height, "Sag under the weight: " + title_of(scene),
                     gravity_subtitle(of, still.size()),
                     grid + operation_band(scene, x) + room.panel(75, 430) +
                         panel_axes(result, "Static deflection (µm)", true) +
                         draw("p", still, true, operation_key(scene, x)));
}

bool moves(const results::GravityResponse &of) {
    return std::any_of(of.stations.begin(), of.stations.end(), [](const auto &station) {
        return std::any_of(station.twice.begin(), station.twice.end(),
                           [](double value) { return value != 0; });
    });
}

} // namespace

Figure gravity_figure(const model::Case &scene, const ResponseResult &result) {
    const results::GravityResponse &of = *result.gravity;
    if (!moves(of))
        return sag_figure(scene, result);
    std::vector<Curve> circle;
    std::vector<Curve> still;
    std::vector<Curve> force;
    for (const std::size_t i : drawn_of(of.stations)) {
        const auto &station = of.stations[i];
        circle.push_back({place_text(station.name, station.z),
                          dense(of.curves, i, result.speeds, station.twice, micrometres)});
        still.push_back({"", over_speed(result.speeds, station.sag, still_micrometres)});
    }
    for (std::size_t i = 0; i < of.bearings.size() && i < most_curves; ++i) {
        const auto &bearing = of.bearings[i];
        force.push_back(
            {place_text(name_or(bearing.name, "bearing"), bearing.z),
             dense(of.curves, of.stations.size() + i, result.speeds, bearing.twice, newtons)});
    }
    LegendedFigure room = beside_legend(92, 842, 1080, names_of(circle, force));
    room.height = 1040;
    const Range x = speed_axis(result);
    return figure_of(
        room.width, room.height, "Motion under the weight: " + title_of(scene),
        gravity_subtitle(of, circle.size()),
        grid + operation_band(scene, x) + logarithmic_axis(circle) + room.panel(75, 430) +
            panel_axes(result, "Circle at twice the spin speed (µm)", false) +
            draw("a", circle, true, operation_key(scene, x)) + "unset label\n" + linear_y +
            "set autoscale y\nset ytics auto\n" + room.panel(460, 700) +
            panel_axes(result, "Static deflection (µm)", false) + draw("p", still, false) +
            logarithmic_axis(force) + room.panel(730, 975) +
            panel_axes(result, "Bearing force at 2x (N)", true) + draw("f", force, true));
}

} // namespace whirl::report
