#include "report/pictures/figures.h"

#include "report/pictures/style.h"
#include "results/show.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace whirl::report {

namespace {

using results::BalancerNumbers;
using results::CompositeCurves;
using Values = std::vector<double>;

/// One line of a panel.
struct Line {
    const Values &y;
    LineStyle style;
    std::string title;
    double width = 2;
};

/// @param first  behind the lines
std::string plot_lines(const Values &x, const std::vector<Line> &lines,
                       const std::string &first = "") {
    Curves drawn;
    drawn.add(first);
    for (const Line &line : lines)
        drawn.add(points_over(x, 1, line.y, 1), line_look(line.style, line.width),
                  line.title.empty() ? "" : "'" + line.title + "'");
    return drawn.script();
}

const LineStyle grey{"", "#9A9A9A", "(3,4)", 7};

/// Axes of a panel over the balls' mass, with a mark at the case's own.
std::string mass_axes(const BalancerNumbers &balancer, const std::string &title) {
    return fmt::format("set title '{}'\nset xlabel 'n m / M_s'\nset xrange [0:{}]\n"
                       "set yrange [0:*]\nset grid lc rgb '#E4E4E4' lt 1\nunset arrow\n",
                       title, balancer.curves->m.back()) +
           upright(balancer.dimensionless.m, "lc rgb '#B00020' lw 1 dt (6,4)");
}

/// The unsigned harmonic gives other curves.
bool paper_differs(const BalancerNumbers &balancer) {
    return std::abs(*balancer.D - std::abs(*balancer.D)) > 1e-9;
}

std::string inertia_panel(const BalancerNumbers &balancer) {
    const CompositeCurves &c = *balancer.curves;
    std::vector<Line> lines{{c.A_m, series_style(2), "A_m"},
                            {c.A_C1, series_style(0), "A_{C1}"},
                            {c.A_C2, series_style(1), "A_{C2}"}};
    if (paper_differs(balancer)) {
        lines.push_back({c.A_C1_paper, grey, "A_{C1}, A_{C2} with |D|", 1.4});
        lines.push_back({c.A_C2_paper, grey, "", 1.4});
    }
    return mass_axes(balancer, "Inertias of the balls and of the rotor / A_Σ") +
           // Room for the legend above the curves.
           fmt::format("set yrange [0:{}]\nset key top left opaque maxrows 2\n",
                       1.45 * std::max({c.A_C1.back(), c.A_C2.back(), c.A_C1_paper.back(),
                                        c.A_C2_paper.back(), c.A_m.back()})) +
           plot_lines(c.m, lines) + "unset label\n"; // the heading is drawn
}

std::string anisotropy_panel(const BalancerNumbers &balancer) {
    const CompositeCurves &c = *balancer.curves;
    std::string text =
        mass_axes(balancer, "Inertial anisotropy / A_Σ") + "set key left top opaque maxrows 4\n";
    std::string band;
    if (!c.A_least.empty() && std::abs(c.A_largest.back() - c.A_least.back()) > 1e-9) {
        text += "$band << EOD\n";
        for (std::size_t i = 0; i < c.m.size(); ++i)
            text += fmt::format("{} {} {}\n", c.m[i], c.A_least[i], c.A_largest[i]);
        text += "EOD\n";
        band =
            "$band using 1:2:3 with filledcurves lc rgb '#D6E6F2' title 'all balanced positions'";
    }
    LineStyle bound = grey;
    bound.dash = "1";
    std::vector<Line> lines{{c.A_without, bound, "D_A = 0 and 1", 1}, {c.A_full, bound, "", 1}};
    if (paper_differs(balancer))
        lines.push_back({c.A_paper, series_style(1),
                         fmt::format("unsigned D_A = {:.4g}", std::abs(*balancer.D))});
    lines.push_back(
        {c.A, series_style(0),
         std::abs(balancer.D->imag()) > 1e-12
             ? fmt::format("D = {:.4g} {:+.4g} i", balancer.D->real(), balancer.D->imag())
             : fmt::format("D_c = {:.4g}", balancer.D->real())});
    return text + plot_lines(c.m, lines, band);
}

std::string polar_panel(const BalancerNumbers &balancer) {
    const CompositeCurves &c = *balancer.curves;
    return mass_axes(balancer, "Polar inertia C / A_Σ") + "unset key\nset yrange [*:*]\n" +
           plot_lines(c.m, {{c.C, series_style(0), ""}});
}

/// The curve with radius A_C in the direction of its axis.
std::string hodograph_panel(const BalancerNumbers &balancer) {
    const CompositeCurves &c = *balancer.curves;
    const auto around = [&](const Values &radius) {
        std::vector<PlotPoint> points;
        for (std::size_t i = 0; i < radius.size(); ++i)
            points.push_back({radius[i] * std::cos(c.angle[i]), radius[i] * std::sin(c.angle[i])});
        return points;
    };
    const double reach = 1.15 * std::max(*std::max_element(c.A_C.begin(), c.A_C.end()),
                                         *std::max_element(c.A_C_paper.begin(), c.A_C_paper.end()));
    Curves drawn;
    drawn.add(around(Values(c.angle.size(), 1)), "with lines lw 1 dt (2,3) lc rgb '#7A7A7A'",
              "'mean, A_Σ'");
    if (paper_differs(balancer))
        drawn.add(around(c.A_C_paper), line_look(series_style(1), 1.8), "'unsigned D_A'");
    drawn.add(around(c.A_C), line_look(series_style(0), 2), "'A_C'");
    return "unset arrow\nset title 'Diametral inertia / A_Σ about an axis, by its direction'\n"
           "set size ratio -1\nset xlabel 'direction of the imbalance'\n"
           "set key outside right center\n" +
           axes_over({-reach, reach}, {-reach, reach}) + drawn.script();
}

} // namespace

Figure composite_figure(const model::Case &scene, const results::ShowResult &result,
                        std::size_t index, const Units &units) {
    const BalancerNumbers &balancer = result.balancers.at(index);
    const std::string name = model::name_or_number(balancer.name, "balancer", index);
    return figure_of(1180, 940, "Composite rotor: " + title_of(scene),
                     fmt::format("{} at z = {}, capacity E = {}; dotted upright line: the case",
                                 name, drawn_value(units, Quantity::length, balancer.z),
                                 std::isinf(balancer.E) ? "infinite" : drawn_number(balancer.E)),
                     panel_margins(0.07, 0.47, 0.56, 0.87) + inertia_panel(balancer) +
                         panel_margins(0.56, 0.97, 0.56, 0.87) + anisotropy_panel(balancer) +
                         panel_margins(0.07, 0.47, 0.08, 0.43) + polar_panel(balancer) +
                         panel_margins(0.56, 0.97, 0.08, 0.43) + hodograph_panel(balancer));
}

} // namespace whirl::report
