#include "report/pictures/figures.h"

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

/// A panel of efficiencies, with a line where the balancer neither helps nor harms.
ChartPanel efficiency_panel(int height, const ChartAxis &x, const std::string &heading) {
    ChartPanel panel{
        height, x, {.title = "Efficiency n", .low = 0, .high = highest_efficiency}, {}, heading};
    panel.curves.push_back(level_line(panel, 1, {"", "#555555", "(4,4)"}));
    return panel;
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
std::vector<PlotPoint> motion_points(const Units &units, const results::PendulumBalance &of,
                                     bool stable, bool collision) {
    std::vector<PlotPoint> points;
    for (std::size_t i = 0; i < of.states.size(); ++i)
        for (const auto &state : of.states[i])
            if (state.stable == stable && state.collision == collision &&
                state.ratio < 1.2 * highest_efficiency)
                points.push_back({units(Quantity::speed, of.speeds[i]), state.ratio});
    return points;
}

/// The steady motions, kind by kind, those that there are: a legend names nothing else.
void add_motions(const Units &units, const results::PendulumBalance &balancer, ChartPanel &panel) {
    struct Kind {
        bool stable, collision;
        LineStyle style;
        double size;
    };
    static const Kind kinds[] = {
        {true, false, {"flexible, stable", "#007D5A", "1", 7}, 0.7},
        {false, false, {"flexible, unstable", "#D55E00", "1", 6}, 0.8},
        {true, true, {"stable, pendulums collide", "#3C97CF", "1", 5}, 0.6},
        {false, true, {"unstable, pendulums collide", "#A8527F", "1", 2}, 0.6}};
    for (const Kind &kind : kinds) {
        std::vector<PlotPoint> points = motion_points(units, balancer, kind.stable, kind.collision);
        if (!points.empty())
            panel.curves.push_back({kind.style.name, std::move(points), kind.style, 0, kind.size});
    }
}

} // namespace

Chart pendulum_chart(const model::Case &scene, const results::PendulumBalance &balancer,
                     const Units &units) {
    const ChartAxis x = along_speeds(units, balancer.speeds);
    const double threshold = units(Quantity::speed, balancer.threshold * balancer.omega_0);
    ChartPanel panel = efficiency_panel(475, x, "");
    const auto add = [&](const std::string &name, std::vector<PlotPoint> points,
                         const std::string &colour, const std::string &dash, double width) {
        panel.curves.push_back({name, std::move(points), {"", colour, dash, 7}, width});
    };
    const double speed = units.factor(Quantity::speed);
    add("planar, small angles", efficiencies(balancer.speeds, speed, balancer.approximate, 3),
        "#7A7A7A", "(12,5)", 2);
    add("planar, exact", efficiencies(balancer.speeds, speed, balancer.planar, 3), "#B77F00", "1",
        2);
    add_motions(units, balancer, panel);
    panel.curves.push_back(
        level_line(panel, balancer.limit, {"fast rotation 1/(1 + ρ)", "#007D5A", "(2,4)"}));
    if (threshold >= *x.low && threshold <= *x.high)
        panel.curves.push_back(upright_line(panel, threshold, {"threshold", "#5B2A86", "(2,4)"}));
    return {"Four-pendulum balancer: " + title_of(scene),
            fmt::format("z = {}, ρ = {}; {}", drawn_value(units, Quantity::length, balancer.z, 4),
                        drawn_number(balancer.rho, 4), efficiency_meaning),
            {panel}};
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
ChartPanel curves_panel(const std::string &heading, const ChartAxis &x,
                        const std::vector<PendulumCurve> &curves, const auto &title_of_curve) {
    ChartPanel panel = efficiency_panel(375, x, heading);
    const std::string stable = "1", unstable = "(2,2)";
    for (std::size_t i = 0; i < curves.size(); ++i) {
        const PendulumCurve &curve = curves[i];
        panel.curves.push_back(
            chart_curve(title_of_curve(curve), exact_points(curve, true), i, 2.4, stable));
        panel.curves.push_back(chart_curve("", exact_points(curve, false), i, 1.8, unstable));
        panel.curves.push_back({"",
                                efficiencies(curve.ratios, 1, curve.approximate, 2),
                                {"", "#8A8A8A", stable, 7},
                                0.8});
    }
    // The three ways of drawing, once.
    panel.curves.push_back({"exact, stable", {}, {"", "#555555", stable, 7}, 2.4});
    panel.curves.push_back({"exact, unstable", {}, {"", "#555555", unstable, 7}, 1.8});
    panel.curves.push_back({"small angles", {}, {"", "#8A8A8A", stable, 7}, 0.8});
    return panel;
}

std::string design_title(const Units &units, const PendulumCurve &of) {
    return fmt::format("l {}, a {}, ρ {}", drawn_value(units, Quantity::length, of.arm, 3),
                       drawn_value(units, Quantity::length, of.pivot, 3), drawn_number(of.rho, 3));
}
std::string damping_title(const PendulumCurve &of) {
    return "H = " + drawn_number(of.external_damping, 3);
}

} // namespace

Chart pendulum_designs_chart(const model::Case &scene, const results::PendulumBalance &balancer,
                             const Units &units) {
    const auto &shown = balancer.dampings.front();
    const ChartAxis x{.title = "Spin speed / resonance",
                      .low = shown.ratios.front(),
                      .high = shown.ratios.back()};
    Chart chart{"Efficiency of the pendulum balancer: " + title_of(scene),
                fmt::format("planar rotor, z = {}, h = {}; {}",
                            drawn_value(units, Quantity::length, balancer.z, 4),
                            drawn_number(balancer.hinge_damping, 3), efficiency_meaning),
                {}};
    if (!balancer.designs.empty())
        chart.panels.push_back(curves_panel(
            "Designs, external damping " + damping_title(balancer.designs.front()), x,
            balancer.designs, [&](const PendulumCurve &of) { return design_title(units, of); }));
    chart.panels.push_back(curves_panel("External damping, ρ = " + drawn_number(shown.rho, 4), x,
                                        balancer.dampings, damping_title));
    return chart;
}

} // namespace whirl::report
