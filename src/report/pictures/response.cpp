#include "report/pictures/figures.h"

#include "report/common/words.h"
#include "report/pictures/chart.h"
#include "report/response/marks.h"
#include "results/response.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

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

/// Of all places, or of many those with names first, filled up with others.
template <class Place> std::vector<std::size_t> drawn_of(const std::vector<Place> &places) {
    std::vector<std::size_t> named;
    std::vector<std::size_t> others;
    for (std::size_t i = 0; i < places.size(); ++i)
        (places[i].name.empty() ? others : named).push_back(i);
    std::vector<std::size_t> chosen;
    for (const auto &list : {named, others})
        for (const std::size_t i : spread_over(list.size(), most_curves - chosen.size()))
            chosen.push_back(list[i]);
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

/// The index-th curve, with a mark here and there.
ChartCurve marked(const std::string &name, std::vector<PlotPoint> points, std::size_t index,
                  bool on_page) {
    ChartCurve curve = chart_curve(name, std::move(points), index);
    curve.marker = 0.8;
    curve.every = std::max<std::size_t>(1, curve.points.size() / 9);
    curve.on_page = on_page;
    return curve;
}

/// Logarithmic: at most three powers of ten down from the largest value of the smallest curve and
/// six from that of all, so that the start from rest does not squeeze the peaks.
ChartPanel logarithmic_panel(int height, const ChartAxis &x, ChartAxis y,
                             std::vector<ChartCurve> curves) {
    span_decades(y, curves, 1e-6, 1e-3);
    return {height, x, y, std::move(curves)};
}

ChartPanel phase_panel(const Units &units, const ChartAxis &x, const std::string &what,
                       std::vector<ChartCurve> curves) {
    return {240, x, phase_axis(units, what), std::move(curves)};
}

ChartCurve mark_curve(const std::string &name, std::vector<PlotPoint> points, int point,
                      double size) {
    return {name, std::move(points), {"", "#000000", "1", point}, 0, size};
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
std::vector<ChartCurve> forces_of(const Units &units, const std::vector<Bearing> &bearings,
                                  std::vector<double> Bearing::*largest,
                                  const results::ResponseCurves &curves, std::size_t before,
                                  const std::vector<double> &speeds) {
    std::vector<ChartCurve> forces;
    for (std::size_t i = 0; i < bearings.size(); ++i)
        forces.push_back(marked(
            "force in " + place_text(units, name_or(bearings[i].name, "bearing"), bearings[i].z),
            dense(units, curves, before + i, speeds, bearings[i].*largest, Quantity::force), i,
            i >= most_curves));
    return forces;
}

/// Peaks of the largest station with speed and amplification factor, and half-power points.
void add_peaks(const Units &units, const HarmonicMotion &result, ChartPanel &panel) {
    const auto largest = largest_station(result);
    if (!largest)
        return;
    const auto &of = result.nodes[*largest];
    ChartCurve tops = mark_curve("peaks of " + place_text(units, of.name, of.z), {}, 6, 1.7);
    ChartCurve halves = mark_curve("half power", {}, 2, 1);
    for (const results::ResponsePeak *peak : labelled_peaks(result, *largest)) {
        const double value = units(Quantity::amplitude, peak->value);
        const double speed = units(Quantity::speed, peak->speed);
        tops.points.push_back({speed, value});
        panel.labels.push_back({peak_text(units, *peak, result.resonances), speed, value});
        tops.texts.push_back((peak->mode.empty() ? "" : peak->mode + "\n") +
                             peak_text(units, *peak, result.resonances) + "\n" +
                             units.text(Quantity::amplitude, peak->value));
        for (const std::optional<double> &half : {peak->lower, peak->upper}) {
            const double x = units(Quantity::speed, half.value_or(NAN));
            if (peak->amplification && x >= *panel.x.low && x <= *panel.x.high)
                halves.points.push_back({x, value / std::sqrt(2.0)});
        }
    }
    for (ChartCurve &marks : {std::ref(tops), std::ref(halves)})
        if (!marks.points.empty())
            panel.curves.push_back(std::move(marks));
}

/// @param heading  in front of the title of the case
Chart motion_chart(const model::Case &scene, const std::vector<double> &speeds,
                   const HarmonicMotion &result, const std::string &heading, std::string subtitle,
                   const Units &units) {
    const results::ResponseCurves &curves = result.curves;
    std::vector<ChartCurve> amplitude;
    std::vector<ChartCurve> phase;
    const auto add = [&](std::size_t i, const std::string &name, const auto &of, bool on_page) {
        const std::size_t index = amplitude.size();
        amplitude.push_back(
            marked(name, dense(units, curves, i, speeds, of.amplitude, Quantity::amplitude), index,
                   on_page));
        const bool fine = i < curves.values.size();
        phase.push_back(
            marked(name,
                   angles_over(fine ? curves.speeds : speeds, units.factor(Quantity::speed),
                               fine ? curves.phases[i] : of.phase),
                   index, on_page));
    };
    const std::vector<std::size_t> nodes = drawn_nodes(result);
    const auto add_node = [&](std::size_t i, bool on_page) {
        add(i, place_text(units, result.nodes[i].name, result.nodes[i].z), result.nodes[i],
            on_page);
    };
    for (const std::size_t i : nodes)
        add_node(i, false);
    for (std::size_t i = 0; i < result.probes.size(); ++i) {
        const auto &probe = result.probes[i];
        add(result.nodes.size() + result.bearings.size() + i,
            fmt::format("{} at {}", place_text(units, name_or(probe.name, "probe"), probe.z),
                        degrees_text(probe.angle)),
            probe, amplitude.size() >= 2 * most_curves);
    }
    for (std::size_t i = 0; i < result.nodes.size(); ++i)
        if (!std::ranges::binary_search(nodes, i))
            add_node(i, true);
    const ChartAxis x = along_speeds(units, speeds);
    std::vector<ChartPanel> panels{
        logarithmic_panel(355, x, chart_axis(units, "Amplitude", Quantity::amplitude),
                          std::move(amplitude)),
        phase_panel(units, x, result.probes.empty() ? "Phase of x" : "Phase of x, of a probe",
                    std::move(phase))};
    add_peaks(units, result, panels.front());
    if (!result.bearings.empty())
        panels.push_back(
            logarithmic_panel(245, x, chart_axis(units, "Largest bearing force", Quantity::force),
                              forces_of(units, result.bearings, &results::ResponseBearing::force,
                                        curves, result.nodes.size(), speeds)));
    if (nodes.size() < result.nodes.size())
        subtitle += (subtitle.empty() ? "" : "; ") +
                    fmt::format("{} stations drawn of {}", nodes.size(), result.nodes.size());
    return {heading + title_of(scene), subtitle, std::move(panels)};
}

} // namespace

Chart response_chart(const model::Case &scene, const ResponseResult &result, const Units &units) {
    return motion_chart(scene, result.speeds, result, "Unbalance response: ", "", units);
}

std::string excitation_text(const Units &units, const results::ForceResponse &response) {
    return response.multiple ? readable(*response.multiple) + "x"
                             : units.text(Quantity::frequency, response.frequency.value_or(0));
}

Chart force_chart(const model::Case &scene, const std::vector<double> &speeds,
                  const results::ForceResponse &response, const Units &units) {
    return motion_chart(
        scene, speeds, response, "Response to forces at " + excitation_text(units, response) + ": ",
        joined(response.forces, ", ",
               [&units](const auto &force) {
                   return fmt::format("{} {} at {}",
                                      units.text(Quantity::force, force.amplitude, 4),
                                      force.direction, place(force.name, force.z, units));
               }),
        units);
}

std::string direction_text(const Units &units, const std::string &direction, double from,
                           double to) {
    return fmt::format("{}, {} to {}", direction, units.text(Quantity::length, from, 4),
                       units.text(Quantity::length, to, 4));
}

Chart receptance_chart(const model::Case &scene, const results::ReceptanceResponse &response,
                       const Units &units) {
    std::vector<ChartCurve> amplitude;
    std::vector<ChartCurve> phase;
    for (const results::Receptance &one : response.receptances)
        for (const results::ReceptanceDirection &direction : one.directions) {
            if (std::ranges::none_of(direction.amplitude, [](double value) { return value > 0; }))
                continue;
            const results::ResponseCurves &curve = direction.curve;
            const bool fine = !curve.values.empty();
            const std::vector<double> &at = fine ? curve.speeds : response.frequencies;
            const std::string name = direction_text(units, direction.name, one.from, one.to);
            const std::size_t index = amplitude.size();
            const bool on_page = index >= 2 * most_curves;
            amplitude.push_back(
                marked(name,
                       over_speed(units, at, fine ? curve.values.front() : direction.amplitude,
                                  Quantity::receptance, Quantity::frequency),
                       index, on_page));
            phase.push_back(marked(name,
                                   angles_over(at, units.factor(Quantity::frequency),
                                               fine ? curve.phases.front() : direction.phase),
                                   index, on_page));
        }
    std::vector<PlotPoint> tops;
    for (const results::ReceptancePeak &peak : response.peaks)
        if (std::isfinite(peak.value))
            tops.push_back({units(Quantity::frequency, peak.frequency),
                            units(Quantity::receptance, peak.value)});
    const ChartAxis x = chart_axis(units, "Frequency of the force", Quantity::frequency,
                                   response.frequencies.front(), response.frequencies.back());
    std::vector<ChartPanel> panels{
        logarithmic_panel(355, x, chart_axis(units, "Receptance", Quantity::receptance),
                          std::move(amplitude)),
        phase_panel(units, x, "Phase", std::move(phase))};
    if (!tops.empty())
        panels.front().curves.push_back(mark_curve("peaks", tops, 6, 1.4));
    return {"Receptance: " + title_of(scene),
            "deflection over force, directions of the deflection and of the force; at " +
                units.text(Quantity::speed, response.speed),
            std::move(panels)};
}

Chart gravity_chart(const model::Case &scene, const ResponseResult &result, const Units &units) {
    const results::GravityResponse &of = *result.gravity;
    std::vector<ChartCurve> circle;
    std::vector<ChartCurve> still;
    const std::vector<std::size_t> drawn = drawn_of(of.stations);
    const auto add = [&](std::size_t i, bool on_page) {
        const auto &station = of.stations[i];
        const std::string name = place_text(units, station.name, station.z);
        const std::size_t index = circle.size();
        circle.push_back(marked(
            name, dense(units, of.curves, i, result.speeds, station.twice, Quantity::amplitude),
            index, on_page));
        still.push_back(marked(name,
                               over_speed(units, result.speeds, station.sag, Quantity::deflection),
                               index, on_page));
    };
    for (const std::size_t i : drawn)
        add(i, false);
    for (std::size_t i = 0; i < of.stations.size(); ++i)
        if (!std::ranges::binary_search(drawn, i))
            add(i, true);
    std::string subtitle =
        "gravity " + drawn_value(units, Quantity::acceleration, of.gravity) + " towards −y";
    if (drawn.size() < of.stations.size())
        subtitle += fmt::format(", {} stations drawn of {}", drawn.size(), of.stations.size());
    const ChartAxis x = along_speeds(units, result.speeds);
    ChartPanel sag{240, x, chart_axis(units, "Static deflection", Quantity::deflection),
                   std::move(still)};
    const bool moves = std::ranges::any_of(of.stations, [](const auto &station) {
        return std::ranges::any_of(station.twice, [](double value) { return value != 0; });
    });
    // A shaft that is equally stiff in all directions stands still in its sag.
    if (!moves)
        return {"Sag under the weight: " + title_of(scene), subtitle, {sag}};
    return {"Motion under the weight: " + title_of(scene),
            subtitle,
            {logarithmic_panel(
                 355, x, chart_axis(units, "Circle at twice the spin speed", Quantity::amplitude),
                 std::move(circle)),
             sag,
             logarithmic_panel(245, x, chart_axis(units, "Bearing force at 2x", Quantity::force),
                               forces_of(units, of.bearings, &results::GravityBearing::twice,
                                         of.curves, of.stations.size(), result.speeds))}};
}

} // namespace whirl::report
