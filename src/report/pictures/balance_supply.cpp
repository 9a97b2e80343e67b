#include "report/balance_supply.h"
#include "report/pictures/figures.h"

#include "results/balance.h"

#include <algorithm>
#include <cmath>

namespace whirl::report {

using results::BalanceResult;
using results::LeftAt;
using results::LeftMotion;

namespace {

constexpr std::size_t most_left_panels = 4;
/// Values further below the largest are drawn at this share of it: nothing is left.
constexpr double drawn_zero = 1e-4;

const LineStyle nothing_look{"nothing", "#8A8A8A", "1", 7};
const LineStyle weights_look{"best weights", "#0072B2", "(7,3)", 7};
const LineStyle idle_look{"balanced position that does not keep", "#58A890", "(2,3)", 7};
const LineStyle balancers_look{"balancers", "#007D5A", "1", 7};
const LineStyle both_look{"weights and balancers", "#D55E00", "(3,3)", 7};

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

/// Lines over the speeds; of one speed points.
void take(ChartPanel &panel, const BalanceResult &result, std::vector<PlotPoint> points,
          const LineStyle &style, double width, const std::string &name) {
    const bool point = result.speeds.size() == 1;
    panel.curves.push_back({name, std::move(points), style, point ? 0 : width, point ? 1.0 : 0.0});
}

ChartPanel left_panel(const Units &units, const BalanceResult &result, const LeftAt &left,
                      bool legend) {
    const std::vector<bool> &works = result.supply->works;
    std::vector<bool> idle = works;
    idle.flip();
    const double bottom = drawn_zero * units(Quantity::amplitude, largest_of(left.amplitude));
    ChartPanel panel{230,
                     along_speeds(units, result.speeds),
                     chart_axis(units, "Amplitude", Quantity::amplitude),
                     {},
                     place_text(units, left.name, left.z)};
    const auto add = [&](const LeftMotion::Values &values, const LineStyle &style, double width,
                         const std::vector<bool> &shown = {}) {
        take(panel, result, left_points(units, result.speeds, values, bottom, shown), style, width,
             legend ? style.name : "");
    };
    add(left.amplitude.nothing, nothing_look, 1.6);
    add(left.amplitude.weights, weights_look, 1.8);
    add(left.amplitude.balancers, idle_look, 1.3, idle);
    add(left.amplitude.balancers, balancers_look, 2.2, works);
    add(left.amplitude.both, both_look, 1.8, works);
    panel.y.logarithmic = bottom > 0;
    panel.y.low = 0.5 * bottom;
    panel.y.high = bottom > 0 ? 2 * units(Quantity::amplitude, largest_of(left.amplitude)) : 1;
    return panel;
}

ChartPanel need_panel(const Units &units, const BalanceResult &result) {
    const results::BalanceSupply &supply = *result.supply;
    const bool shares = std::ranges::all_of(supply.planes, [](const results::PlaneSupply &plane) {
        return plane.capacity && *plane.capacity > 0;
    });
    ChartPanel panel{230,
                     along_speeds(units, result.speeds),
                     shares ? ChartAxis{.title = "Needed over capacity"}
                            : chart_axis(units, "Needed", Quantity::imbalance),
                     {}};
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
        take(panel, result, std::move(points), series_style(p), 2,
             model::name_or_number(result.planes[p].name, "plane", p));
    }
    if (shares)
        panel.curves.push_back({"all there is",
                                {{*panel.x.low, 1}, {*panel.x.high, 1}},
                                {"", "#B0305C", "(8,4)", 7},
                                1.4});
    panel.y.low = 0;
    if (const double top = std::max(1.25 * largest, shares ? 1.25 : 0); top > 0)
        panel.y.high = top;
    return panel;
}

} // namespace

Chart residual_chart(const model::Case &scene, const BalanceResult &result, const Units &units) {
    Chart chart{"What weights and balancers leave: " + title_of(scene),
                "weights: the best in the same planes; balancers and both where the criterion "
                "holds; at the bottom: nothing is left",
                {}};
    for (const LeftAt *left : places_for_readers(*result.supply, most_left_panels))
        chart.panels.push_back(left_panel(units, result, *left, chart.panels.empty()));
    chart.panels.push_back(need_panel(units, result));
    return chart;
}

} // namespace whirl::report
