#include "report/pictures/figures.h"

#include "report/pictures/operation.h"
#include "report/pictures/style.h"
#include "results/pendulum.h"

#include <fmt/format.h>

#include <cmath>
#include <string>

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
    return grid + axes_over(x, {0, highest_efficiency}) +
           fmt::format(
               "set xlabel '{}'\nset ylabel 'Efficiency n'\n"
               "set key at graph 1.02,1 left top reverse Left vertical samplen 2.5 spacing 1.3\n"
               "set arrow from graph 0,first 1 to graph 1,first 1 nohead lc rgb '#555555' dt "
               "(4,4)\n",
               x_name);
}

/// Efficiencies over the speed, with gaps where they are far off the picture.
/// @param far  in picture heights
template <class Value>
std::vector<PlotPoint> efficiencies(const std::vector<double> &x, double factor,
                                    const std::vector<Value> &values, double far) {
    std::vector<PlotPoint> points;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const std::optional<double> value = values[i];
        const bool drawn = value && std::isfinite(*value) && *value < far * highest_efficiency;
        points.push_back({x[i] * factor, drawn ? value : std::nullopt});
    }
    return points;
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
void add_motions(const results::PendulumBalance &balancer, Curves &drawn) {
    struct Kind {
        bool stable, collision;
        const char *look, *title;
    };
    static constexpr Kind kinds[] = {
        {true, false, "pt 7 ps 0.7 lc rgb '#007D5A'", "'flexible, stable'"},
        {false, false, "pt 6 ps 0.8 lw 1.3 lc rgb '#D55E00'", "'flexible, unstable'"},
        {true, true, "pt 5 ps 0.6 lc rgb '#3C97CF'", "'stable, pendulums collide'"},
        {false, true, "pt 2 ps 0.6 lc rgb '#A8527F'", "'unstable, pendulums collide'"}};
    for (const Kind &kind : kinds) {
        const std::vector<PlotPoint> points = motion_points(balancer, kind.stable, kind.collision);
        if (!points.empty())
            drawn.add(points, std::string("with points ") + kind.look, kind.title);
    }
}

} // namespace

Figure pendulum_figure(const model::Case &scene, const results::PendulumBalance &balancer,
                       const Units &) {
    const Range x = speed_range(balancer.speeds);
    const double threshold = balancer.threshold * balancer.omega_0 * rpm;
    Curves drawn;
    drawn.add(efficiencies(balancer.speeds, rpm, balancer.approximate, 3),
              "with lines lw 2 dt (12,5) lc rgb '#7A7A7A'", "'planar, small angles'");
    drawn.add(efficiencies(balancer.speeds, rpm, balancer.planar, 3),
              "with lines lw 2 lc rgb '#B77F00'", "'planar, exact'");
    add_motions(balancer, drawn);
    drawn.add(fmt::format("{:.6g} with lines dt (2,4) lc rgb '#007D5A' title 'fast rotation "
                          "1/(1 + ρ)'",
                          balancer.limit));
    drawn.add(operation_key(scene, x));
    constexpr int height = 620;
    return figure_of(
        1080, height, "Four-pendulum balancer: " + title_of(scene),
        fmt::format("z = {} m, ρ = {}; {}", readable(balancer.z, 4), readable(balancer.rho, 4),
                    efficiency_meaning),
        panel_margins(0.075, 0.74, 70.0 / height, 1 - 75.0 / height) + operation_band(scene, x) +
            efficiency_axes(x, "Spin speed (rpm)") +
            upright(threshold, "lc rgb '#5B2A86' dt (2,4)") +
            fmt::format("set label 'threshold' at first {:.9g},{} left offset 0.5,0 textcolor "
                        "'#5B2A86'\n",
                        threshold, 0.95 * highest_efficiency) +
            drawn.script());
}

namespace {

using results::PendulumCurve;

std::vector<PlotPoint> exact_points(const PendulumCurve &of, bool stable) {
    std::vector<PlotPoint> points;
    for (std::size_t i = 0; i < of.ratios.size(); ++i) {
        const bool shown =
            of.exact[i] && of.stable[i] == stable && *of.exact[i] < 2 * highest_efficiency;
        points.push_back({of.ratios[i], shown ? of.exact[i] : std::nullopt});
    }
    return points;
}

/// @param title_of_curve  in the legend
std::string panel(const std::string &heading, const std::vector<PendulumCurve> &curves,
                  const auto &title_of_curve) {
    Curves drawn;
    for (std::size_t i = 0; i < curves.size(); ++i) {
        const PendulumCurve &curve = curves[i];
        const std::string colour = series_style(i).colour;
        drawn.add(exact_points(curve, true), fmt::format("with lines lw 2.4 lc rgb '{}'", colour),
                  plot_text(title_of_curve(curve)));
        drawn.add(exact_points(curve, false),
                  fmt::format("with lines lw 1.8 dt (2,2) lc rgb '{}'", colour));
        drawn.add(efficiencies(curve.ratios, 1, curve.approximate, 2),
                  "with lines lw 0.8 lc rgb '#8A8A8A'");
    }
    // The three ways of drawing, once.
    drawn.add("NaN with lines lw 2.4 lc rgb '#555555' title 'exact, stable'");
    drawn.add("NaN with lines lw 1.8 dt (2,2) lc rgb '#555555' title 'exact, unstable'");
    drawn.add("NaN with lines lw 0.8 lc rgb '#8A8A8A' title 'small angles'");
    return fmt::format("set title {} offset 0,-0.5\n", plot_text(heading)) + drawn.script();
}

std::string design_title(const PendulumCurve &of) {
    return fmt::format("l {} m, a {} m, ρ {}", readable(of.arm, 3), readable(of.pivot, 3),
                       readable(of.rho, 3));
}
std::string damping_title(const PendulumCurve &of) {
    return "H = " + readable(of.external_damping, 3);
}

} // namespace

Figure pendulum_designs_figure(const model::Case &scene, const results::PendulumBalance &balancer,
                               const Units &) {
    const bool both = !balancer.designs.empty();
    const LegendedFigure room{1080, 0.075, 0.70, both ? 1010 : 560};
    const auto &shown = balancer.dampings.front();
    std::string panels =
        efficiency_axes({shown.ratios.front(), shown.ratios.back()}, "Spin speed / resonance");
    if (both)
        panels += room.panel(105, 480) +
                  panel("Designs, external damping " + damping_title(balancer.designs.front()),
                        balancer.designs, design_title) +
                  "unset label\n";
    panels +=
        room.panel(both ? 590 : 105, both ? 940 : 490) +
        panel("External damping, ρ = " + readable(shown.rho, 4), balancer.dampings, damping_title);
    return figure_of(room.width, room.height,
                     "Efficiency of the pendulum balancer: " + title_of(scene),
                     fmt::format("planar rotor, z = {} m, h = {}; {}", readable(balancer.z, 4),
                                 readable(balancer.hinge_damping, 3), efficiency_meaning),
                     panels);
}

} // namespace whirl::report
