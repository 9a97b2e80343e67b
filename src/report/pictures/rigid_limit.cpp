#include "report/pictures/figures.h"

#include "report/pictures/style.h"
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

/// What a panel draws, and how far it reaches.
struct Panel {
    Curves curves{};
    double least_x = INFINITY, largest_x = 0, largest_y = 0, least_y = INFINITY;

    void add(const std::string &title, const LineStyle &style, bool filled,
             const std::vector<PlotPoint> &points) {
        if (points.empty())
            return;
        curves.add(points,
                   fmt::format("with linespoints lw {} dt {} pt {} ps 1 lc rgb '{}'",
                               filled ? 1.8 : 1.0, filled ? "1" : "(4,4)", style.point,
                               style.colour),
                   title.empty() ? "" : plot_text(title));
        for (const PlotPoint &point : points) {
            least_x = std::min(least_x, point.x);
            largest_x = std::max(largest_x, point.x);
            largest_y = std::max(largest_y, *point.y);
            least_y = std::min(least_y, *point.y);
        }
    }
    [[nodiscard]] bool empty() const { return curves.empty(); }
    [[nodiscard]] std::string script(const std::string &before) const {
        return empty() ? "set xrange [1:10]\nset yrange [1e-12:1]\nplot NaN notitle\n"
                       : curves.script(before);
    }
};

std::string stiffness_panel(const Units &units, const RigidLimitResult &result, Styles &styles) {
    Panel panel;
    for (const RigidLimitRow &row : result.rows)
        if (row.elements.empty())
            panel.add("", style_of(row.quantity, styles), true, points_of(units, row));
    std::string text;
    std::string guide;
    if (panel.largest_x > panel.least_x) {
        text +=
            axes_over({panel.least_x / 1.5, panel.largest_x * 1.5},
                      {std::max(panel.least_y / 10, 1e-13), std::min(10 * panel.largest_y, 1e3)});
        guide = fmt::format("{}/x with lines lw 1 dt (2,3) lc rgb '#7A7A7A' notitle, "
                            "0.01 with lines lw 1 dt (8,4) lc rgb '#999999' notitle",
                            3 * panel.largest_y * panel.least_x);
    }
    if (panel.empty())
        text += "set label 1 'a rigid shaft: no stiffness to vary' at graph 0.5,0.5 center\n"
                "unset xtics\nunset ytics\n";
    if (result.one_percent)
        text += upright(units(Quantity::stiffness, result.one_percent->stiffness),
                        "back lw 1 dt (8,4) lc rgb '#999999'");
    return text + "set xlabel " +
           axis_text(units, "Stiffness of the shaft, 48 EI/L³", Quantity::stiffness) +
           "\n"
           "set ylabel 'Relative difference from the closed form'\nunset key\n" +
           panel.script(guide) + "unset arrow\nunset label\nset autoscale\nset xtics\nset ytics\n";
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

std::string mesh_panel(const Units &units, const RigidLimitResult &result, Styles &styles) {
    Panel panel;
    std::vector<int> orders;
    for (const RigidLimitRow &row : result.rows) {
        if (row.elements.empty())
            continue;
        if (std::find(orders.begin(), orders.end(), row.order) == orders.end())
            orders.push_back(row.order);
        const bool main = row.order == result.model.order;
        if (!row.inertia)
            panel.add(main ? units.text(row.quantity) : "", style_of(row.quantity, styles), main,
                      points_of(units, row));
    }
    for (const int order : orders) {
        const bool main = order == result.model.order;
        panel.add(main ? "composite inertia, largest" : "", {"", "#555555", "1", 2}, main,
                  inertia_points(result, order));
    }
    // Lines of the other panel are explained here, where there is room.
    std::string keys = "NaN with lines lw 1 dt (2,3) lc rgb '#7A7A7A' title 'slope -1', NaN with "
                       "lines lw 1 dt (8,4) lc rgb '#999999' title '1 %'";
    if (orders.size() > 1)
        keys += ", NaN with lines lw 1 dt (4,4) lc rgb '#555555' title 'thin: classical elements'";
    std::string text;
    if (!panel.empty())
        text +=
            axes_over({0.8 * panel.least_x, 1.25 * panel.largest_x},
                      {least_shown / 2, std::max(1e-3, 10 * panel.largest_y)}) +
            // What lies this low differs by nothing but rounding, and its ups and downs say no
            // more.
            "set object 1 rectangle from graph 0,graph 0 to graph 1,first 1e-12 behind fc rgb "
            "'#F0F0F0' fs solid noborder\nset label 1 'rounding' at graph 0.02,first 4e-13 left "
            "font ',10' textcolor '#777777'\n";
    return text +
           "set xlabel 'Elements of the shaft'\nunset ylabel\nset xtics (1,2,3,4,6,8,12,16,24,32)\n"
           "set format x '%g'\nset key at graph 1.04,1 left top reverse Left vertical samplen 3\n" +
           panel.script(keys);
}

} // namespace

Figure rigid_limit_figure(const model::Case &scene, const RigidLimitResult &result,
                          const Units &units) {
    const std::string subtitle =
        std::isfinite(result.mesh_factor)
            ? fmt::format("left: while the shaft stiffens; right: while the mesh coarsens, E and G "
                          "times {}",
                          drawn_number(result.mesh_factor))
            : "the shaft is rigid";
    Styles styles;
    const std::string left =
        panel_margins(0.07, 0.375, 0.115, 0.87) + stiffness_panel(units, result, styles);
    return figure_of(
        1400, 620, "Flexible model and rigid closed forms: " + title_of(scene), subtitle,
        std::string("set logscale xy\nset format xy '10^{%L}'\n") + grid + left +
            panel_margins(0.425, 0.7, 0.115, 0.87) + mesh_panel(units, result, styles));
}

} // namespace whirl::report
