#include "report/pictures/figures.h"

#include "report/pictures/style.h"
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

constexpr int influence_head = 96; // pixels
constexpr int amplitude_height = 230;
constexpr int phase_height = 120;
constexpr int influence_gap = 66;
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

struct PlanePanels {
    std::string amplitude, phase;
};

PlanePanels plane_panels(const Units &units, const WeightsResult &result, const std::string &plane,
                         bool last) {
    const double speed = units.factor(Quantity::speed);
    const double unit = units.factor(Quantity::influence);
    Curves amplitudes, phases;
    const std::vector<const InfluenceCurve *> curves = drawn_curves(result, plane);
    double largest = 0;
    for (std::size_t i = 0; i < curves.size(); ++i) {
        std::vector<PlotPoint> line;
        std::vector<double> angles;
        for (std::size_t k = 0; k < result.curve_speeds.size(); ++k) {
            const auto &value = curves[i]->values[k];
            const bool there = value && *value != 0.0; // zero has no logarithm and no phase
            if (there)
                largest = std::max(largest, unit * std::abs(*value));
            line.push_back({speed * result.curve_speeds[k],
                            there ? std::optional(unit * std::abs(*value)) : std::nullopt});
            angles.push_back(there ? std::arg(*value) : std::nan(""));
        }
        const std::string look = line_look(series_style(i), 1.8);
        amplitudes.add(line, look, plot_text(curve_name(units, *curves[i])));
        phases.add(angles_over(result.curve_speeds, speed, angles), look);
    }
    const bool moves = largest > 0;
    if (!moves)
        amplitudes.add("NaN with lines lc rgb '#8A8A8A' title 'nothing moves'");
    return {"set title " + plot_text("Unit weight in " + plane) + " offset 0,-0.6\n" + grid +
                (moves ? logarithmic_y + fmt::format("set yrange [{}:{}]\n",
                                                     drawn_decades * largest, 2 * largest)
                       : std::string(linear_y) + "set yrange [0:1]\n") +
                "set ytics autofreq\nset format x ''\nunset xlabel\nset ylabel " +
                axis_text(units, "Response", Quantity::influence) + "\n" + legend_beside +
                amplitudes.script() + "unset title\n",
            std::string(grid) + linear_y +
                "set yrange [-190:190]\nset ytics 90\nset format x '%g'\nset ylabel " +
                axis_text(units, "Phase", Quantity::angle) + "\n" +
                (last ? "set xlabel " + axis_text(units, "Spin speed", Quantity::speed) + "\n"
                      : std::string()) +
                "unset key\n" + phases.script()};
}

} // namespace

Figure influence_figure(const model::Case &scene, const WeightsResult &result, const Units &units) {
    const std::vector<std::string> planes = planes_of(result);
    std::vector<std::string> names;
    for (const InfluenceCurve *curve : drawn_curves(result, planes.front()))
        names.push_back(curve_name(units, *curve));
    const int each = amplitude_height + phase_height + influence_gap + 14;
    const int height = influence_head + static_cast<int>(planes.size()) * each + 24;
    const LegendedFigure figure = beside_legend(860, 1080, height, names);
    const Range x = speed_range(units, result.curve_speeds);
    std::string script = fmt::format("set xrange [{}:{}]\n", x.low, x.high);
    for (std::size_t p = 0; p < planes.size(); ++p) {
        const PlanePanels panels = plane_panels(units, result, planes[p], p + 1 == planes.size());
        const int top = influence_head + static_cast<int>(p) * each;
        const int below = top + amplitude_height + 14;
        script += figure.panel(top, top + amplitude_height) + panels.amplitude +
                  figure.panel(below, below + phase_height) + panels.phase;
    }
    const std::size_t places = drawn_curves(result, planes.front()).size();
    std::string subtitle = "vibration over weight, as each place reads it";
    subtitle += result.lag ? "; phases lag" : "; phases lead";
    if (const std::size_t all = result.weights.size(); planes.size() < all)
        subtitle += fmt::format("; {} of {} planes", planes.size(), all);
    if (places == most_places)
        subtitle += fmt::format("; {} places at most", most_places);
    return figure_of(figure.width, height, "Influence of weights: " + title_of(scene), subtitle,
                     script);
}

} // namespace whirl::report
