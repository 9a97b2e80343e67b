#include "report/pictures/figures.h"

#include "report/common/words.h"
#include "report/pictures/operation.h"
#include "report/pictures/style.h"
#include "report/response/marks.h"
#include "results/response.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace whirl::report {

using results::HarmonicMotion;
using results::ResponseResult;

namespace {

constexpr std::size_t most_curves = 8;

std::vector<PlotPoint> over_speed(const Units &units, const std::vector<double> &speeds,
                                  const std::vector<double> &values, Quantity of,
                                  Quantity along = Quantity::speed) {
    std::vector<PlotPoint> points =
        points_over(speeds, units.factor(along), values, units.factor(of));
    for (PlotPoint &point : points)
        if (!std::isfinite(*point.y) || *point.y <= 0) // the response at rest is zero, which a
            point.y.reset();                           // logarithmic axis has no place for
    return points;
}

/// Logarithmic axis over the curves, at most three powers of ten down from the largest value of the
/// smallest of them and six from that of all, so that the start from rest does not squeeze the
/// peaks; with room for the names of these.
Range logarithmic_range(const std::vector<NamedCurve> &curves) {
    double high = 0;
    double low = HUGE_VAL;
    double smallest = HUGE_VAL; // of the largest values
    for (const NamedCurve &curve : curves) {
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

std::string logarithmic_axis(const std::vector<NamedCurve> &curves) {
    const Range y = logarithmic_range(curves);
    return logarithmic_y + fmt::format("set ytics auto\nset yrange [{}:{}]\n", y.low, y.high);
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

std::vector<std::size_t> drawn_nodes(const HarmonicMotion &result) {
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

/// A panel over the spin speed: the name and the kind of its axis, curves with and without names.
struct SpeedPanel {
    std::string label;
    std::string axis;
    std::vector<NamedCurve> curves;
};
SpeedPanel logarithmic_panel(const std::string &label, const std::vector<NamedCurve> &curves) {
    return {label, logarithmic_axis(curves), curves};
}

Curves curves_of(const SpeedPanel &panel) {
    Curves drawn;
    for (std::size_t i = 0; i < panel.curves.size(); ++i) {
        const auto &[name, points] = panel.curves[i];
        const LineStyle style = series_style(i);
        drawn.add(points,
                  fmt::format("with linespoints lc rgb '{}' lw 1.8 dt {} pt {} ps 0.8 "
                              "pointinterval {}",
                              style.colour, style.dash, style.point,
                              std::max<std::size_t>(1, points.size() / 9)),
                  name.empty() ? "" : plot_text(name));
    }
    return drawn;
}

/// What panels are over: the spin speed, or the frequency of a force.
struct Along {
    std::string label;
    Range range;
    bool speed = true;
};
Along along_speeds(const Units &units, const std::vector<double> &speeds) {
    return {units.label("Spin speed", Quantity::speed), speed_range(units, speeds)};
}

/// Up to three panels one below the other.
/// @param marks  in the first one
Figure stacked(const model::Case &scene, const Units &units, const Along &along,
               const std::string &heading, const std::string &subtitle,
               const std::vector<SpeedPanel> &panels, const PeakMarks &marks) {
    struct Place {
        int top, bottom, height; ///< of the panel; of the figure where it is the last; pixels
    };
    constexpr Place places[] = {{75, 430, 500}, {460, 700, 780}, {730, 975, 1040}};
    std::vector<std::string> names{marks.name};
    if (along.speed)
        names.emplace_back("operating speeds");
    for (const SpeedPanel &panel : panels)
        for (const NamedCurve &curve : panel.curves)
            names.push_back(curve.name);
    const LegendedFigure room = beside_legend(842, 1080, places[panels.size() - 1].height, names);
    const Range &x = along.range;
    std::string script = grid + (along.speed ? operation_band(scene, units, x) : "") +
                         fmt::format("set xrange [{}:{}]\n{}", x.low, x.high, marks.before);
    for (std::size_t i = 0; i < panels.size(); ++i) {
        Curves drawn = curves_of(panels[i]);
        if (i == 0) {
            drawn.add(marks.plots);
            if (along.speed)
                drawn.add(operation_key(scene, units, x));
        }
        script += panels[i].axis + room.panel(places[i].top, places[i].bottom) +
                  axes_beside_legend(panels[i].label, i + 1 == panels.size() ? along.label : "") +
                  drawn.script() + (i == 0 ? marks.after : "") + "unset label\n";
    }
    return figure_of(room.width, room.height, heading + title_of(scene), subtitle, script);
}

/// The values at the speeds of the case, or those of the i-th dense curve where there is one.
std::vector<PlotPoint> dense(const Units &units, const results::ResponseCurves &curves,
                             std::size_t i, const std::vector<double> &speeds,
                             const std::vector<double> &values, Quantity of) {
    return i < curves.values.size() ? over_speed(units, curves.speeds, curves.values[i], of)
                                    : over_speed(units, speeds, values, of);
}

std::string name_or(const std::string &name, const char *kind) {
    return name.empty() ? kind : name;
}

/// Forces in the bearings: `largest` of each over the speeds of the case.
/// @param before  dense curves of other places in front of theirs
template <class Bearing>
std::vector<NamedCurve> forces_of(const Units &units, const std::vector<Bearing> &bearings,
                                  std::vector<double> Bearing::*largest,
                                  const results::ResponseCurves &curves, std::size_t before,
                                  const std::vector<double> &speeds) {
    std::vector<NamedCurve> forces;
    for (std::size_t i = 0; i < bearings.size() && i < most_curves; ++i)
        forces.push_back(
            {place_text(units, name_or(bearings[i].name, "bearing"), bearings[i].z),
             dense(units, curves, before + i, speeds, bearings[i].*largest, Quantity::force)});
    return forces;
}

} // namespace

namespace {

/// @param heading  in front of the title of the case
Figure motion_figure(const model::Case &scene, const std::vector<double> &speeds,
                     const HarmonicMotion &result, const std::string &heading,
                     const std::string &of, const Units &units) {
    const results::ResponseCurves &curves = result.curves;
    std::vector<NamedCurve> amplitude;
    std::vector<NamedCurve> phase;
    const auto add = [&](std::size_t i, const std::string &name, const auto &of) {
        amplitude.push_back(
            {name, dense(units, curves, i, speeds, of.amplitude, Quantity::amplitude)});
        const bool fine = i < curves.values.size();
        phase.push_back(
            {"", angles_over(fine ? curves.speeds : speeds, units.factor(Quantity::speed),
                             fine ? curves.phases[i] : of.phase)});
    };
    const std::vector<std::size_t> nodes = drawn_nodes(result);
    for (const std::size_t i : nodes)
        add(i, place_text(units, result.nodes[i].name, result.nodes[i].z), result.nodes[i]);
    for (std::size_t i = 0; i < result.probes.size() && amplitude.size() < 2 * most_curves; ++i) {
        const auto &probe = result.probes[i];
        add(result.nodes.size() + result.bearings.size() + i,
            fmt::format("{} at {}", place_text(units, name_or(probe.name, "probe"), probe.z),
                        degrees_text(probe.angle)),
            probe);
    }
    std::vector<SpeedPanel> panels{
        logarithmic_panel(units.label("Amplitude", Quantity::amplitude), amplitude),
        {units.label(result.probes.empty() ? "Phase of x" : "Phase of x, of a probe",
                     Quantity::angle),
         std::string(linear_y) + "set yrange [-190:190]\nset ytics 90\n", phase}};
    if (!result.bearings.empty())
        panels.push_back(
            logarithmic_panel(units.label("Largest bearing force", Quantity::force),
                              forces_of(units, result.bearings, &results::ResponseBearing::force,
                                        curves, result.nodes.size(), speeds)));
    PeakMarks marks;
    if (const auto largest = largest_station(result))
        marks = peak_marks(units, result, *largest,
                           {speed_range(units, speeds), logarithmic_range(amplitude), 750, 355},
                           amplitude);
    return stacked(scene, units, along_speeds(units, speeds), heading,
                   fmt::format("{}{} stations drawn of {}", of, nodes.size(), result.nodes.size()),
                   panels, marks);
}

} // namespace

Figure response_figure(const model::Case &scene, const ResponseResult &result, const Units &units) {
    return motion_figure(scene, result.speeds, result, "Unbalance response: ", "", units);
}

std::string excitation_text(const Units &units, const results::ForceResponse &response) {
    return response.multiple ? readable(*response.multiple) + "x"
                             : units.text(Quantity::frequency, response.frequency.value_or(0));
}

Figure force_figure(const model::Case &scene, const std::vector<double> &speeds,
                    const results::ForceResponse &response, const Units &units) {
    return motion_figure(
        scene, speeds, response, "Response to forces at " + excitation_text(units, response) + ": ",
        joined(response.forces, ", ",
               [&units](const auto &force) {
                   return fmt::format("{} {} at {}",
                                      units.text(Quantity::force, force.amplitude, 4),
                                      force.direction, place(force.name, force.z, units));
               }) +
            "; ",
        units);
}

std::string direction_text(const Units &units, const std::string &direction, double from,
                           double to) {
    return fmt::format("{}, {} to {}", direction, units.text(Quantity::length, from, 4),
                       units.text(Quantity::length, to, 4));
}

Figure receptance_figure(const model::Case &scene, const results::ReceptanceResponse &response,
                         const Units &units) {
    std::vector<NamedCurve> amplitude;
    std::vector<NamedCurve> phase;
    for (const results::Receptance &one : response.receptances)
        for (const results::ReceptanceDirection &direction : one.directions) {
            const bool moves =
                std::ranges::any_of(direction.amplitude, [](double value) { return value > 0; });
            if (!moves || amplitude.size() >= 2 * most_curves)
                continue;
            const results::ResponseCurves &curve = direction.curve;
            const bool fine = !curve.values.empty();
            const std::vector<double> &at = fine ? curve.speeds : response.frequencies;
            amplitude.push_back(
                {direction_text(units, direction.name, one.from, one.to),
                 over_speed(units, at, fine ? curve.values.front() : direction.amplitude,
                            Quantity::receptance, Quantity::frequency)});
            phase.push_back({"", angles_over(at, units.factor(Quantity::frequency),
                                             fine ? curve.phases.front() : direction.phase)});
        }
    PeakMarks marks;
    std::vector<PlotPoint> tops;
    for (const results::ReceptancePeak &peak : response.peaks)
        if (std::isfinite(peak.value))
            tops.push_back({units(Quantity::frequency, peak.frequency),
                            units(Quantity::receptance, peak.value)});
    if (!tops.empty()) {
        marks.name = "peaks";
        marks.before = data_block("tops", {tops});
        marks.plots = "$tops with points pt 6 ps 1.4 lw 1.4 lc rgb '#000000' title 'peaks'";
    }
    return stacked(scene, units,
                   {units.label("Frequency of the force", Quantity::frequency),
                    {units(Quantity::frequency, response.frequencies.front()),
                     units(Quantity::frequency, response.frequencies.back())},
                    false},
                   "Receptance: ",
                   "deflection over force, directions of the deflection and of the force; at " +
                       units.text(Quantity::speed, response.speed),
                   {logarithmic_panel(units.label("Receptance", Quantity::receptance), amplitude),
                    {units.label("Phase", Quantity::angle),
                     std::string(linear_y) + "set yrange [-190:190]\nset ytics 90\n", phase}},
                   marks);
}

Figure gravity_figure(const model::Case &scene, const ResponseResult &result, const Units &units) {
    const results::GravityResponse &of = *result.gravity;
    std::vector<NamedCurve> circle;
    std::vector<NamedCurve> still;
    const std::vector<std::size_t> drawn = drawn_of(of.stations);
    for (const std::size_t i : drawn) {
        const auto &station = of.stations[i];
        circle.push_back(
            {place_text(units, station.name, station.z),
             dense(units, of.curves, i, result.speeds, station.twice, Quantity::amplitude)});
        still.push_back({"", over_speed(units, result.speeds, station.sag, Quantity::deflection)});
    }
    const std::string subtitle = fmt::format("gravity {} towards −y, {} stations drawn of {}",
                                             drawn_value(units, Quantity::acceleration, of.gravity),
                                             drawn.size(), of.stations.size());
    const bool moves = std::ranges::any_of(of.stations, [](const auto &station) {
        return std::ranges::any_of(station.twice, [](double value) { return value != 0; });
    });
    const Along along = along_speeds(units, result.speeds);
    // A shaft that is equally stiff in all directions stands still in its sag.
    if (!moves) {
        for (std::size_t i = 0; i < still.size(); ++i)
            still[i].name = circle[i].name;
        return stacked(scene, units, along, "Sag under the weight: ", subtitle,
                       {{units.label("Static deflection", Quantity::deflection), "", still}}, {});
    }
    return stacked(scene, units, along, "Motion under the weight: ", subtitle,
                   {logarithmic_panel(
                        units.label("Circle at twice the spin speed", Quantity::amplitude), circle),
                    {units.label("Static deflection", Quantity::deflection),
                     std::string(linear_y) + "set autoscale y\nset ytics auto\n", still},
                    logarithmic_panel(units.label("Bearing force at 2x", Quantity::force),
                                      forces_of(units, of.bearings, &results::GravityBearing::twice,
                                                of.curves, of.stations.size(), result.speeds))},
                   {});
}

} // namespace whirl::report
