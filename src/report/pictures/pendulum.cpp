#include "report/pictures/figures.h"

#include "report/pictures/operation.h"
#include "report/pictures/style.h"
#include "results/pendulum.h"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <utility>

namespace whirl::report {

namespace {

// What the pictures of the efficiency of pendulum balancers have in common.

/// Efficiencies beyond this are off the picture.
constexpr double highest_efficiency = 4;

constexpr const char *efficiency_meaning =
    "shaft deflection with the balancer at work over that with the pendulums held";

/// Axes of one panel or more, with the legend at the right and a line where the balancer neither
/// helps nor harms.
std::string efficiency_axes(Range x, const std::string &x_name) {
    return fmt::format(
        "set grid lc rgb '#E4E4E4' lt 1 lw 0.6\nset xrange [{:.9g}:{:.9g}]\nset yrange [0:{}]\n"
        "set xlabel '{}'\nset ylabel 'Efficiency n'\n"
        "set key at graph 1.02,1 left top reverse Left vertical samplen 2.5 spacing 1.3\n"
        "set arrow from graph 0,first 1 to graph 1,first 1 nohead lc rgb '#555555' dt (4,4)\n",
        x.low, x.high, highest_efficiency, x_name);
}

std::string curve(const std::string &name, const std::vector<double> &speeds,
                  const std::vector<std::optional<double>> &values) {
    std::vector<std::vector<PlotPoint>> lines(1);
    for (std::size_t i = 0; i < speeds.size(); ++i) {
        const bool drawn =
            values[i] && std::isfinite(*values[i]) && *values[i] < 3 * highest_efficiency;
        lines.back().push_back({speeds[i] * rpm, drawn ? values[i] : std::nullopt});
    }
    return data_block(name, lines);
}

/// Points of the steady motions with this stability, apart from or with colliding pendulums.
std::vector<PlotPoint> motion_points(const results::PendulumBalance &of, bool stable,
                                     bool collision) {
    std::vector<PlotPoint> points;
    for (std::size_t i = 0; i < of.states.size(); ++i)
        for (const auto &state : of.states[i])
            if (state.stable == stable && state.collision == collision &&
                state.ratio < 1.2 * highest_efficiency)
                points.push_back({of.speeds[i] * rpm, state.ratio});
    return points;
}

/// The steady motions, kind by kind, those that there are: a legend names nothing else.
struct Motions {
    std::string data;
    std::string plots; ///< each followed by a comma
};
Motions motions_of(const results::PendulumBalance &balancer) {
    struct Kind {
        bool stable, collision;
        const char *look, *title;
    };
    static constexpr Kind kinds[] = {
        {true, false, "pt 7 ps 0.7 lc rgb '#007D5A'", "flexible, stable"},
        {false, false, "pt 6 ps 0.8 lw 1.3 lc rgb '#D55E00'", "flexible, unstable"},
        {true, true, "pt 5 ps 0.6 lc rgb '#3C97CF'", "stable, pendulums collide"},
        {false, true, "pt 2 ps 0.6 lc rgb '#A8527F'", "unstable, pendulums collide"}};
    Motions motions;
    int number = 0;
    for (const Kind &kind : kinds) {
        const std::vector<PlotPoint> points = motion_points(balancer, kind.stable, kind.collision);
        if (points.empty())
            continue;
        const std::string name = fmt::format("motions{}", ++number);
        motions.data += data_block(name, {points});
        motions.plots +=
            fmt::format("${} with points {} title '{}', ", name, kind.look, kind.title);
    }
    return motions;
}

} // namespace

Figure pendulum_figure(const model::Case &scene, const results::PendulumBalance &balancer) {
    Figure figure;
    figure.width = 1080;
    figure.height = 620;
    const double pixel = 1.0 / figure.height;
    const Range speeds = range_of(balancer.speeds);
    const Range x{speeds.low * rpm, speeds.high * rpm};
    const Motions motions = motions_of(balancer);
    const std::vector<std::optional<double>> approximate(balancer.approximate.begin(),
                                                         balancer.approximate.end());
    figure.script =
        figure_head("Four-pendulum balancer: " + title_of(scene),
                    fmt::format("z = {} m, ρ = {}; {}", readable(balancer.z, 4),
                                readable(balancer.rho, 4), efficiency_meaning),
                    figure.height) +
        curve("approximate", balancer.speeds, approximate) +
        curve("planar", balancer.speeds, balancer.planar) + motions.data +
        panel_margins(0.075, 0.74, 70 * pixel, 1 - 75 * pixel) + operation_band(scene, x) +
        efficiency_axes(x, "Spin speed (rpm)") +
        fmt::format(
            "set arrow from first {0:.9g},0 to first {0:.9g},{1} nohead lc rgb '#5B2A86' dt (2,4)\n"
            "set label 'threshold' at first {0:.9g},{2} left offset 0.5,0 textcolor '#5B2A86'\n"
            "plot $approximate with lines lw 2 dt (12,5) lc rgb '#7A7A7A' title 'planar, small "
            "angles', $planar with lines lw 2 lc rgb '#B77F00' title 'planar, exact', "
            "{3}{4:.6g} with lines dt (2,4) lc rgb '#007D5A' title 'fast rotation "
            "1/(1 + ρ)'{5}\nunset multiplot\n",
            balancer.threshold * balancer.omega_0 * rpm, highest_efficiency,
            0.95 * highest_efficiency, motions.plots, balancer.limit, operation_key(scene, x));
    return figure;
}

namespace {

using results::PendulumCurve;

std::string block(const std::string &name, const PendulumCurve &of, bool stable) {
    std::vector<PlotPoint> points;
    for (std::size_t i = 0; i < of.ratios.size(); ++i) {
        const bool shown =
            of.exact[i] && of.stable[i] == stable && *of.exact[i] < 2 * highest_efficiency;
        points.push_back({of.ratios[i], shown ? of.exact[i] : std::nullopt});
    }
    return data_block(name, {points});
}

std::string approximate_block(const std::string &name, const PendulumCurve &of) {
    std::vector<PlotPoint> points;
    for (std::size_t i = 0; i < of.ratios.size(); ++i) {
        const double n = of.approximate[i];
        points.push_back({of.ratios[i], std::isfinite(n) && n < 2 * highest_efficiency
                                            ? std::optional(n)
                                            : std::nullopt});
    }
    return data_block(name, {points});
}

std::string panel(const std::string &name,
                  const std::vector<std::pair<std::string, const PendulumCurve *>> &curves) {
    std::string data;
    std::string plots;
    for (std::size_t i = 0; i < curves.size(); ++i) {
        const auto &[title, curve] = curves[i];
        const std::string of = name + std::to_string(i);
        data += block(of + "s", *curve, true) + block(of + "u", *curve, false) +
                approximate_block(of + "a", *curve);
        plots += fmt::format("{0}${1}s with lines lw 2.4 lc rgb '{2}' title {3}, "
                             "${1}u with lines lw 1.8 dt (2,2) lc rgb '{2}' notitle, "
                             "${1}a with lines lw 0.8 lc rgb '#8A8A8A' notitle",
                             i == 0 ? "plot " : ", ", of, series_style(i).colour, plot_text(title));
    }
    // The three ways of drawing, once.
    plots += ", NaN with lines lw 2.4 lc rgb '#555555' title 'exact, stable', NaN with lines lw "
             "1.8 dt (2,2) lc rgb '#555555' title 'exact, unstable', NaN with lines lw 0.8 lc rgb "
             "'#8A8A8A' title 'small angles'\n";
    return data + plots;
}

std::string design_title(const PendulumCurve &of) {
    return fmt::format("l {} m, a {} m, ρ {}", readable(of.arm, 3), readable(of.pivot, 3),
                       readable(of.rho, 3));
}

} // namespace

Figure pendulum_designs_figure(const model::Case &scene, const results::PendulumBalance &balancer) {
    std::vector<std::pair<std::string, const PendulumCurve *>> designs;
    for (const PendulumCurve &curve : balancer.designs)
        designs.emplace_back(design_title(curve), &curve);
    std::vector<std::pair<std::string, const PendulumCurve *>> dampings;
    for (const PendulumCurve &curve : balancer.dampings)
        dampings.emplace_back("H = " + readable(curve.external_damping, 3), &curve);
    const bool both = !designs.empty();
    Figure figure;
    figure.width = 1080;
    figure.height = both ? 1010 : 560;
    const double pixel = 1.0 / figure.height;
    const auto &shown = balancer.dampings.front();
    const auto place = [&](int top, int bottom) {
        return panel_margins(0.075, 0.70, 1 - bottom * pixel, 1 - top * pixel);
    };
    figure.script =
        figure_head("Efficiency of the pendulum balancer: " + title_of(scene),
                    fmt::format("planar rotor, z = {} m, h = {}; {}", readable(balancer.z, 4),
                                readable(balancer.hinge_damping, 3), efficiency_meaning),
                    figure.height) +
        efficiency_axes({shown.ratios.front(), shown.ratios.back()}, "Spin speed / resonance");
    if (both)
        figure.script +=
            place(105, 480) +
            fmt::format("set title {} offset 0,-0.5\n",
                        plot_text("Designs, external damping H = " +
                                  readable(balancer.designs.front().external_damping, 3))) +
            panel("d", designs) + "unset label\n";
    figure.script +=
        place(both ? 590 : 105, both ? 940 : 490) +
        fmt::format("set title {} offset 0,-0.5\n",
                    plot_text(fmt::format("External damping, ρ = {}", readable(shown.rho, 4)))) +
        panel("h", dampings) + "unset multiplot\n";
    return figure;
}

} // namespace whirl::report
