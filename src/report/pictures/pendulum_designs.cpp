#include "report/pictures/figures.h"

#include "report/pictures/style.h"
#include "results/pendulum.h"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <utility>

namespace whirl::report {

namespace {

using results::PendulumCurve;

/// Efficiencies beyond this are off the picture.
constexpr double highest = 4;

std::string block(const std::string &name, const PendulumCurve &of, bool stable) {
    std::vector<PlotPoint> points;
    for (std::size_t i = 0; i < of.ratios.size(); ++i) {
        const bool shown = of.exact[i] && of.stable[i] == stable && *of.exact[i] < 2 * highest;
        points.push_back({of.ratios[i], shown ? of.exact[i] : std::nullopt});
    }
    return data_block(name, {points});
}

std::string approximate_block(const std::string &name, const PendulumCurve &of) {
    std::vector<PlotPoint> points;
    for (std::size_t i = 0; i < of.ratios.size(); ++i) {
        const double n = of.approximate[i];
        points.push_back(
            {of.ratios[i], std::isfinite(n) && n < 2 * highest ? std::optional(n) : std::nullopt});
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
                    fmt::format("planar rotor, z = {} m, h = {}; shaft deflection with the "
                                "balancer at work over that with the pendulums held",
                                readable(balancer.z, 4), readable(balancer.hinge_damping, 3)),
                    figure.height) +
        fmt::format("set grid lc rgb '#E4E4E4' lt 1 lw 0.6\nset xrange [{}:{}]\nset yrange "
                    "[0:{}]\nset ylabel 'Efficiency n'\nset xlabel 'Spin speed / resonance'\n"
                    "set key at graph 1.02,1 left top reverse Left vertical samplen 2.5 spacing "
                    "1.3\nset arrow from graph 0,first 1 to graph 1,first 1 nohead lc rgb "
                    "'#555555' dt (4,4)\n",
                    shown.ratios.front(), shown.ratios.back(), highest);
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
