#include "report/pictures/figures.h"

#include "report/pictures/style.h"
#include "results/show.h"

#include <fmt/format.h>

#include <cmath>

namespace whirl::report {

namespace {

using results::BalancerNumbers;
using results::CompositeCurves;
using Values = std::vector<double>;

const LineStyle grey{"", "#9A9A9A", "(3,4)"};

/// From zero, or below the least value, to above the largest.
void span(ChartPanel &panel, bool from_zero) {
    Values values;
    for (const ChartCurve &curve : panel.curves)
        for (const PlotPoint &point : curve.points)
            values.push_back(point.y.value_or(0));
    const Range range = range_of(values);
    const double margin = 0.06 * (range.high - range.low);
    panel.y.low = from_zero ? -0.03 * range.high : range.low - margin;
    panel.y.high = range.high + margin;
}

/// Over the balls' mass, with a mark at the case's own.
ChartPanel mass_panel(const BalancerNumbers &balancer, const std::string &what,
                      std::vector<ChartCurve> curves, bool from_zero = true) {
    ChartPanel panel{200,
                     {.title = "n m / M_s", .low = 0, .high = balancer.curves->m.back()},
                     {.title = what},
                     std::move(curves)};
    span(panel, from_zero);
    panel.curves.push_back(
        upright_line(panel, balancer.dimensionless.m, {"the case", "#B00020", "(6,4)"}));
    return panel;
}

ChartCurve over(const Values &x, const Values &y, const std::string &name, const LineStyle &style,
                double width = 2) {
    return {name, points_over(x, 1, y, 1), style, width};
}

/// The unsigned harmonic gives other curves.
bool paper_differs(const BalancerNumbers &balancer) {
    return std::abs(*balancer.D - std::abs(*balancer.D)) > 1e-9;
}

std::vector<ChartCurve> inertia_curves(const BalancerNumbers &balancer) {
    const CompositeCurves &c = *balancer.curves;
    std::vector<ChartCurve> curves{over(c.m, c.A_m, "A_m", series_style(2)),
                                   over(c.m, c.A_C1, "A_C1", series_style(0)),
                                   over(c.m, c.A_C2, "A_C2", series_style(1))};
    if (paper_differs(balancer))
        for (const Values *paper : {&c.A_C1_paper, &c.A_C2_paper})
            curves.push_back(over(c.m, *paper, "A_C1, A_C2 with |D|", grey, 1.4));
    return curves;
}

std::vector<ChartCurve> anisotropy_curves(const BalancerNumbers &balancer) {
    const CompositeCurves &c = *balancer.curves;
    std::vector<ChartCurve> curves;
    if (!c.A_least.empty() && std::abs(c.A_largest.back() - c.A_least.back()) > 1e-9) {
        ChartCurve band =
            chart_area({"all balanced positions", "#D6E6F2"}, points_over(c.m, 1, c.A_least, 1));
        for (std::size_t i = c.m.size(); i-- > 0;)
            band.points.push_back({c.m[i], c.A_largest[i]});
        curves.push_back(band);
    }
    for (const Values *bound : {&c.A_without, &c.A_full})
        curves.push_back(over(c.m, *bound, "D_A = 0 and 1", {"", grey.colour}, 1));
    if (paper_differs(balancer))
        curves.push_back(over(c.m, c.A_paper,
                              fmt::format("unsigned D_A = {:.4g}", std::abs(*balancer.D)),
                              series_style(1)));
    curves.push_back(
        over(c.m, c.A,
             std::abs(balancer.D->imag()) > 1e-12
                 ? fmt::format("D = {:.4g} {:+.4g} i", balancer.D->real(), balancer.D->imag())
                 : fmt::format("D_c = {:.4g}", balancer.D->real()),
             series_style(0)));
    return curves;
}

/// About axes across the rotor, by their direction from the imbalance.
ChartPanel direction_panel(const BalancerNumbers &balancer, const Units &units) {
    const CompositeCurves &c = *balancer.curves;
    const Values angle = scaled(c.angle, units.factor(Quantity::angle));
    ChartPanel panel{200,
                     chart_axis(units, "Direction from the imbalance", Quantity::angle, 0, 2 * pi),
                     {.title = "A_C / A_Σ"}};
    panel.title = "Diametral inertia about an axis, by its direction";
    panel.x.step = *panel.x.high / 8;
    panel.curves = {over(angle, Values(angle.size(), 1), "mean, A_Σ", {"", "#7A7A7A", "(2,3)"}, 1)};
    if (paper_differs(balancer))
        panel.curves.push_back(over(angle, c.A_C_paper, "unsigned D_A", series_style(1), 1.8));
    panel.curves.push_back(over(angle, c.A_C, "A_C", series_style(0)));
    span(panel, false);
    return panel;
}

} // namespace

Chart composite_chart(const model::Case &scene, const results::ShowResult &result,
                      std::size_t index, const Units &units) {
    const BalancerNumbers &balancer = result.balancers.at(index);
    const CompositeCurves &c = *balancer.curves;
    return {"Composite rotor: " + title_of(scene),
            fmt::format("{} at z = {}, capacity E = {}; n m / M_s: mass of the balls over that of "
                        "the rotor",
                        model::name_or_number(balancer.name, "balancer", index),
                        drawn_value(units, Quantity::length, balancer.z),
                        std::isinf(balancer.E) ? "infinite" : drawn_number(balancer.E)),
            {mass_panel(balancer, "Inertias / A_Σ", inertia_curves(balancer)),
             mass_panel(balancer, "Anisotropy / A_Σ", anisotropy_curves(balancer)),
             mass_panel(balancer, "Polar inertia C / A_Σ", {over(c.m, c.C, "C", series_style(3))},
                        false),
             direction_panel(balancer, units)}};
}

} // namespace whirl::report
