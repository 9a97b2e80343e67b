#include "report/pictures/figures.h"

#include "report/pictures/operation.h"
#include "report/pictures/style.h"
#include "results/pendulum.h"

#include <fmt/format.h>

#include <cmath>

namespace whirl::report {

namespace {

/// Deflections beyond this are off the picture.
constexpr double highest = 4;

std::string curve(const std::string &name, const std::vector<double> &speeds,
                  const std::vector<std::optional<double>> &values) {
    std::vector<std::vector<PlotPoint>> lines(1);
    for (std::size_t i = 0; i < speeds.size(); ++i) {
        const bool drawn = values[i] && std::isfinite(*values[i]) && *values[i] < 3 * highest;
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
                state.ratio < 1.2 * highest)
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
    const Range x = range_of(balancer.speeds);
    const Motions motions = motions_of(balancer);
    const std::vector<std::optional<double>> approximate(balancer.approximate.begin(),
                                                         balancer.approximate.end());
    figure.script =
        figure_head("Four-pendulum balancer: " + title_of(scene),
                    fmt::format("z = {} m, ρ = {}; shaft deflection with the balancer at work over "
                                "that with the pendulums held",
                                readable(balancer.z, 4), readable(balancer.rho, 4)),
                    figure.height) +
        curve("approximate", balancer.speeds, approximate) +
        curve("planar", balancer.speeds, balancer.planar) + motions.data +
        panel_margins(0.075, 0.74, 70 * pixel, 1 - 75 * pixel) +
        operation_band(scene, {x.low * rpm, x.high * rpm}) +
        fmt::format(
            "set grid lc rgb '#E4E4E4' lt 1 lw 0.6\nset xrange [{0:.9g}:{1:.9g}]\n"
            "set yrange [0:{2}]\nset xlabel 'Spin speed (rpm)'\nset ylabel 'Efficiency n'\n"
            "set key at graph 1.02,1 left top reverse Left vertical samplen 2.5 spacing 1.3\n"
            "set arrow from first {0:.9g},1 to first {1:.9g},1 nohead lc rgb '#555555' dt (4,4)\n"
            "set arrow from first {3:.9g},0 to first {3:.9g},{2} nohead lc rgb '#5B2A86' dt (2,4)\n"
            "set label 'threshold' at first {3:.9g},{4} left offset 0.5,0 textcolor '#5B2A86'\n"
            "plot $approximate with lines lw 2 dt (12,5) lc rgb '#7A7A7A' title 'planar, small "
            "angles', $planar with lines lw 2 lc rgb '#B77F00' title 'planar, exact', "
            "{7}{5:.6g} with lines dt (2,4) lc rgb '#007D5A' title 'fast rotation "
            "1/(1 + ρ)'{6}\nunset multiplot\n",
            x.low * rpm, x.high * rpm, highest, balancer.threshold * balancer.omega_0 * rpm,
            0.95 * highest, balancer.limit, operation_key(scene, {x.low * rpm, x.high * rpm}),
            motions.plots);
    return figure;
}

} // namespace whirl::report
