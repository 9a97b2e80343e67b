#include "report/pictures/figures.h"
#include "results/weights.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

namespace whirl::report {

using results::InfluenceCurve;
using results::WeightsResult;

namespace {

constexpr double drawn_decades = 1e-5; // of the largest: toward rest everything goes to nothing
constexpr std::size_t most_planes = 4;
constexpr std::size_t most_places = 8;

/// The displacements that are drawn of one plane: of each kind of place as many as there is room.
std::vector<const InfluenceCurve *> drawn_curves(const WeightsResult &result,
                                                 const std::string &plane) {
    std::vector<const InfluenceCurve *> out;
    for (const char *of : {"probe", "station", "bearing"})
        for (const InfluenceCurve &curve : result.influence_curves)
            if (curve.plane == plane && curve.of == of && out.size() < most_places)
                out.push_back(&curve);
    return out;
}

/// "bearing left", "z = 0.3 m": with the direction where there are several.
std::string curve_name(const Units &units, const InfluenceCurve &curve) {
    if (curve.of == "probe")
        return curve.name;
    const std::string where =
        curve.name.empty() ? "z = " + drawn_value(units, Quantity::length, curve.z) : curve.name;
    return curve.angle == 0 ? where : where + ", y";
}

std::vector<std::string> planes_of(const WeightsResult &result) {
    std::vector<std::string> out;
    for (const InfluenceCurve &curve : result.influence_curves)
        if (std::ranges::find(out, curve.plane) == out.end() && out.size() < most_planes)
            out.push_back(curve.plane);
    return out;
}

} // namespace

Chart influence_chart(const model::Case &scene, const WeightsResult &result, const Units &units) {
    const std::vector<std::string> planes = planes_of(result);
    const double unit = units.factor(Quantity::influence);
    Chart chart{"Influence of weights: " + title_of(scene), "", {}};
    for (const std::string &plane : planes) {
        ChartPanel amplitude{230,
                             chart_axis(units, "Spin speed", Quantity::speed),
                             chart_axis(units, "Response", Quantity::influence),
                             {},
                             "Unit weight in " + plane};
        ChartPanel phase{120, amplitude.x, phase_axis(units, "Phase"), {}};
        for (const InfluenceCurve *curve : drawn_curves(result, plane)) {
            std::vector<PlotPoint> line;
            std::vector<double> angles;
            for (std::size_t k = 0; k < result.curve_speeds.size(); ++k) {
                const auto &value = curve->values[k];
                const bool there = value && *value != 0.0; // zero has no logarithm and no phase
                line.push_back({units(Quantity::speed, result.curve_speeds[k]),
                                there ? std::optional(unit * std::abs(*value)) : std::nullopt});
                angles.push_back(there ? std::arg(*value) : std::nan(""));
            }
            const std::size_t index = amplitude.curves.size();
            amplitude.curves.push_back(chart_curve(curve_name(units, *curve), line, index));
            phase.curves.push_back(chart_curve(
                "", angles_over(result.curve_speeds, units.factor(Quantity::speed), angles),
                index));
        }
        span_decades(amplitude.y, amplitude.curves, drawn_decades);
        chart.panels.insert(chart.panels.end(), {amplitude, phase});
    }
    chart.subtitle = std::string("vibration over weight, as each place reads it; phases ") +
                     (result.lag ? "lag" : "lead");
    if (const std::size_t all = result.weights.size(); planes.size() < all)
        chart.subtitle += fmt::format("; {} of {} planes", planes.size(), all);
    if (drawn_curves(result, planes.front()).size() == most_places)
        chart.subtitle += fmt::format("; {} places at most", most_places);
    return chart;
}

} // namespace whirl::report
