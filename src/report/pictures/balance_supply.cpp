#include "report/balance_supply.h"
#include "report/pictures/figures.h"

#include "report/pictures/operation.h"
#include "report/pictures/style.h"
#include "results/balance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace whirl::report {

using results::BalanceResult;
using results::LeftAt;
using results::LeftMotion;

namespace {

constexpr int left_panel_height = 230; // pixels
constexpr int left_panel_gap = 64;
constexpr int left_head_height = 100;
constexpr std::size_t most_left_panels = 4;
/// Values further below the largest are drawn at this share of it: nothing is left.
constexpr double drawn_zero = 1e-4;

constexpr const char *nothing_look = "lw 1.6 lc rgb '#8A8A8A'";
constexpr const char *weights_look = "lw 1.8 dt (7,3) lc rgb '#0072B2'";
constexpr const char *balancers_look = "lw 2.2 lc rgb '#007D5A'";
constexpr const char *both_look = "lw 1.8 dt (3,3) lc rgb '#D55E00'";
constexpr const char *idle_look = "lw 1.3 dt (2,3) lc rgb '#58A890'";

double largest_of(const LeftMotion &motion) {
    double largest = 0;
    for (const LeftMotion::Values *values :
         {&motion.nothing, &motion.weights, &motion.balancers, &motion.both})
        for (const std::optional<double> &value : *values)
            largest = std::max(largest, value.value_or(0));
    return largest;
}

/// @param shown  at these speeds, with the speeds beside them so that lines meet; empty: all
std::vector<PlotPoint> left_points(const Units &units, const std::vector<double> &speeds,
                                   const LeftMotion::Values &values, double bottom,
                                   const std::vector<bool> &shown = {}) {
    std::vector<PlotPoint> points;
    for (std::size_t k = 0; k < speeds.size(); ++k) {
        std::optional<double> value = values[k];
        if (!shown.empty() && !shown[k])
            value.reset();
        points.push_back({units(Quantity::speed, speeds[k]),
                          value
                              ? std::optional(std::max(units(Quantity::amplitude, *value), bottom))
                              : std::nullopt});
    }
    return points;
}

std::string left_panel(const model::Case &scene, const Units &units, const BalanceResult &result,
                       const LeftAt &left, bool legend, Range x) {
    const results::BalanceSupply &supply = *result.supply;
    const double largest = largest_of(left.amplitude);
    const double bottom = drawn_zero * units(Quantity::amplitude, largest);
    const char *lines = result.speeds.size() == 1 ? "points pt 7" : "lines";
    std::vector<bool> idle;
    for (const bool works : supply.works)
        idle.push_back(!works);
    Curves drawn;
    const auto add = [&](const LeftMotion::Values &values, const char *look, const char *title,
                         const std::vector<bool> &shown = {}) {
        drawn.add(left_points(units, result.speeds, values, bottom, shown),
                  fmt::format("with {} {}", lines, look), legend ? fmt::format("'{}'", title) : "");
    };
    if (largest > 0) {
        add(left.amplitude.nothing, nothing_look, "nothing");
        add(left.amplitude.weights, weights_look, "best weights");
        add(left.amplitude.balancers, idle_look, "balanced position that does not keep", idle);
        add(left.amplitude.balancers, balancers_look, "balancers", supply.works);
        add(left.amplitude.both, both_look, "weights and balancers", supply.works);
    } else {
        drawn.add("NaN with lines lc rgb '#8A8A8A' title 'nothing moves'");
    }
    drawn.add(operation_key(scene, units, x));
    return operation_band(scene, units, x) + grid + (largest > 0 ? logarithmic_y : linear_y) +
           (largest > 0 ? fmt::format("set yrange [{}:{}]\n", 0.5 * bottom,
                                      2 * units(Quantity::amplitude, largest))
                        : std::string("set yrange [0:1]\n")) +
           "set title " + plot_text(place_text(units, left.name, left.z)) + " offset 0,-0.6\n" +
           "set ylabel " + axis_text(units, "Amplitude", Quantity::amplitude) + "\nunset xlabel\n" +
           (legend ? legend_beside : "unset key\n") + drawn.script() +
           "unset object\nunset arrow\nunset title\nunset label\n";
}

std::string need_panel(const model::Case &scene, const Units &units, const BalanceResult &result,
                       Range x) {
    const results::BalanceSupply &supply = *result.supply;
    const bool shares = std::ranges::all_of(supply.planes, [](const results::PlaneSupply &plane) {
        return plane.capacity && *plane.capacity > 0;
    });
    Curves drawn;
    double largest = 0;
    for (std::size_t p = 0; p < supply.planes.size(); ++p) {
        const results::PlaneSupply &plane = supply.planes[p];
        const double unit = shares ? 1 / *plane.capacity : units.factor(Quantity::imbalance);
        std::vector<PlotPoint> points;
        for (std::size_t k = 0; k < result.speeds.size(); ++k) {
            const auto &need = plane.needed[k];
            points.push_back({units(Quantity::speed, result.speeds[k]),
                              need ? std::optional(unit * std::abs(*need)) : std::nullopt});
            if (need && supply.works[k])
                largest = std::max(largest, unit * std::abs(*need));
        }
        drawn.add(points,
                  result.speeds.size() == 1
                      ? fmt::format("with points pt 7 lc rgb '{}'", series_style(p).colour)
                      : line_look(series_style(p), 2),
                  plot_text(model::name_or_number(result.planes[p].name, "plane", p)));
    }
    if (shares)
        drawn.add("1 with lines lw 1.4 dt (8,4) lc rgb '#B0305C' title 'all there is'");
    const double top = std::max(1.25 * largest, shares ? 1.25 : 0);
    return operation_band(scene, units, x) + grid + linear_y +
           (top > 0 ? fmt::format("set yrange [0:{}]\n", top) : std::string("set yrange [0:*]\n")) +
           "set ylabel " +
           (shares ? plot_text("Needed over capacity")
                   : axis_text(units, "Needed", Quantity::imbalance)) +
           "\nset xlabel " + axis_text(units, "Spin speed", Quantity::speed) + "\n" +
           legend_beside + drawn.script() + "unset object\nunset arrow\n";
}

} // namespace

Figure residual_figure(const model::Case &scene, const BalanceResult &result, const Units &units) {
    const std::vector<const LeftAt *> places = places_for_readers(*result.supply, most_left_panels);
    const int panels = static_cast<int>(places.size()) + 1;
    const int height = left_head_height + panels * (left_panel_height + left_panel_gap);
    std::vector<std::string> names{"balanced position that does not keep"};
    for (const results::BalancePlane &plane : result.planes)
        names.push_back(plane.name);
    const LegendedFigure figure = beside_legend(880, 1100, height, names);
    const Range x = speed_range(units, result.speeds);
    const auto place = [&](int index) {
        const int top = left_head_height + index * (left_panel_height + left_panel_gap);
        return figure.panel(top, top + left_panel_height);
    };
    std::string script = fmt::format("set xrange [{}:{}]\n", x.low, x.high);
    for (std::size_t i = 0; i < places.size(); ++i)
        script +=
            place(static_cast<int>(i)) + left_panel(scene, units, result, *places[i], i == 0, x);
    script += place(panels - 1) + need_panel(scene, units, result, x);
    return figure_of(figure.width, height, "What weights and balancers leave: " + title_of(scene),
                     "weights: the best in the same planes; balancers and both where the "
                     "criterion holds; at the bottom: nothing is left",
                     script);
}

} // namespace whirl::report
