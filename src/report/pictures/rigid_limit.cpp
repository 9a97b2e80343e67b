#include "report/pictures/figures.h"

#include "results/rigid_limit.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace whirl::report {

using results::RigidLimitResult;
using results::RigidLimitRow;

namespace {

/// Differences below this are drawn here: zero has no logarithm.
constexpr double least_shown = 1e-17;

/// Indices of the styles of quantities, in the order in which these are drawn first.
using Styles = std::map<std::string, std::size_t>;
LineStyle style_of(const std::string &quantity, Styles &styles) {
    return series_style(styles.emplace(quantity, styles.size()).first->second);
}

std::vector<PlotPoint> points_of(const Units &units, const RigidLimitRow &row) {
    std::vector<PlotPoint> points;
    for (std::size_t k = 0; k < row.relative_difference.size(); ++k) {
        const double x =
            row.elements.empty() ? units(Quantity::stiffness, row.stiffness[k]) : row.elements[k];
        if (std::isfinite(x) && row.relative_difference[k])
            points.push_back({x, std::max(*row.relative_difference[k], least_shown)});
    }
    return points;
}

/// A line with marks: thick where the elements are those of the case.
void take(ChartPanel &panel, const std::string &title, LineStyle style, bool main,
          std::vector<PlotPoint> points) {
    if (points.empty())
        return;
    style.dash = main ? "1" : "(4,4)";
    panel.curves.push_back({title, std::move(points), style, main ? 1.8 : 1.0, 1});
}

/// Ends of the points of all curves.
struct Reach {
    double least_x = INFINITY, largest_x = 0, least_y = INFINITY, largest_y = 0;
    explicit Reach(const ChartPanel &panel) {
        for (const ChartCurve &curve : panel.curves)
            for (const PlotPoint &point : curve.points) {
                least_x = std::min(least_x, point.x);
                largest_x = std::max(largest_x, point.x);
                least_y = std::min(least_y, *point.y);
                largest_y = std::max(largest_y, *point.y);
            }
    }
};

/// Over the stiffness, with a slope of -1 and the stiffness from which 1 % is kept.
ChartPanel stiffness_panel(const Units &units, const RigidLimitResult &result, Styles &styles) {
    ChartPanel panel{400,
                     chart_axis(units, "Stiffness of the shaft, 48 EI/L³", Quantity::stiffness),
                     {.title = "Relative difference from the closed form", .logarithmic = true},
                     {},
                     "While the shaft stiffens"};
    panel.x.logarithmic = true;
    for (const RigidLimitRow &row : result.rows)
        if (row.elements.empty())
            take(panel, units.text(row.quantity), style_of(row.quantity, styles), true,
                 points_of(units, row));
    const Reach reach(panel);
    if (!(reach.largest_x > reach.least_x))
        return panel;
    panel.x.low = reach.least_x / 1.5;
    panel.x.high = reach.largest_x * 1.5;
    panel.y.low = std::max(reach.least_y / 10, 1e-13);
    panel.y.high = std::min(10 * reach.largest_y, 1e3);
    const double guide = 3 * reach.largest_y * reach.least_x;
    panel.curves.push_back(
        {"slope -1",
         {{*panel.x.low, guide / *panel.x.low}, {*panel.x.high, guide / *panel.x.high}},
         {"", "#7A7A7A", "(2,3)", 7},
         1});
    std::vector<PlotPoint> percent{{*panel.x.low, 0.01}, {*panel.x.high, 0.01}};
    if (result.one_percent) {
        const double from = units(Quantity::stiffness, result.one_percent->stiffness);
        percent.insert(percent.end(),
                       {{from, std::nullopt}, {from, *panel.y.low}, {from, *panel.y.high}});
    }
    panel.curves.push_back({"1 %", percent, {"", "#999999", "(8,4)", 7}, 1});
    return panel;
}

/// Of the composite inertia the quantity that differs most, at every mesh.
std::vector<PlotPoint> inertia_points(const RigidLimitResult &result, int order) {
    std::map<double, double> largest;
    for (const RigidLimitRow &row : result.rows)
        if (row.inertia && row.order == order)
            for (std::size_t k = 0; k < row.elements.size(); ++k)
                if (row.relative_difference[k])
                    largest[row.elements[k]] = std::max(
                        {least_shown, largest[row.elements[k]], *row.relative_difference[k]});
    std::vector<PlotPoint> points;
    for (const auto &[x, y] : largest)
        points.push_back({x, y});
    return points;
}

ChartPanel mesh_panel(const Units &units, const RigidLimitResult &result, Styles &styles) {
    ChartPanel panel{330,
                     {.title = "Elements of the shaft", .logarithmic = true},
                     {.title = "Relative difference from the closed form", .logarithmic = true},
                     {},
                     "While the mesh coarsens"};
    std::vector<int> orders;
    for (const RigidLimitRow &row : result.rows) {
        if (row.elements.empty())
            continue;
        if (std::find(orders.begin(), orders.end(), row.order) == orders.end())
            orders.push_back(row.order);
        const bool main = row.order == result.model.order;
        if (!row.inertia)
            take(panel, main ? units.text(row.quantity) : "", style_of(row.quantity, styles), main,
                 points_of(units, row));
    }
    for (const int order : orders) {
        const bool main = order == result.model.order;
        take(panel, main ? "composite inertia, largest" : "", {"", "#555555", "1", 2}, main,
             inertia_points(result, order));
    }
    if (panel.curves.empty())
        return panel;
    if (orders.size() > 1)
        panel.curves.push_back({"thin: classical elements", {}, {"", "#555555", "(4,4)", 7}, 1});
    const Reach reach(panel);
    panel.x.low = 0.8 * reach.least_x;
    panel.x.high = 1.25 * reach.largest_x;
    panel.y.low = least_shown / 2;
    panel.y.high = std::max(1e-3, 10 * reach.largest_y);
    // What lies this low differs by nothing but rounding, and its ups and downs say no more.
    panel.curves.push_back({"below: rounding",
                            {{*panel.x.low, 1e-12}, {*panel.x.high, 1e-12}},
                            {"", "#BBBBBB", "1", 7},
                            1});
    return panel;
}

} // namespace

Chart rigid_limit_chart(const model::Case &scene, const RigidLimitResult &result,
                        const Units &units) {
    Chart chart{"Flexible model and rigid closed forms: " + title_of(scene),
                std::isfinite(result.mesh_factor)
                    ? "E and G times " + drawn_number(result.mesh_factor) +
                          " while the mesh coarsens"
                    : "the shaft is rigid: no stiffness to vary",
                {}};
    Styles styles;
    for (const ChartPanel &panel :
         {stiffness_panel(units, result, styles), mesh_panel(units, result, styles)})
        if (!panel.curves.empty())
            chart.panels.push_back(panel);
    return chart;
}

} // namespace whirl::report
