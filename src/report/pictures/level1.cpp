#include "report/pictures/figures.h"

#include "report/pictures/style.h"
#include "results/level1.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace whirl::report {

namespace {

/// The unit of stiffness in which the largest one is neither long nor short.
struct StiffnessUnit {
    double size = 1; ///< N/m
    std::string name = "N/m";
};
StiffnessUnit unit_of(double largest) {
    if (const auto asked = written_factor("stiffness"))
        return {1 / *asked, unit_name("stiffness", "")};
    for (const StiffnessUnit &unit :
         {StiffnessUnit{1e9, "GN/m"}, StiffnessUnit{1e6, "MN/m"}, StiffnessUnit{1e3, "kN/m"}})
        if (largest >= unit.size)
            return unit;
    return {};
}

/// Where the curve passes zero: a circle and its number.
std::string root_mark(double q, double largest, const StiffnessUnit &unit) {
    const bool right = q < 0.7 * largest;
    return fmt::format("set label 1 'Q_0 = {0} {4}' at first {1:.9g},0 {2} offset {3},1 point pt 6 "
                       "ps 1.7 lw 1.6 font ',11' front enhanced\n",
                       readable(q, 6), q, right ? "left" : "right", right ? 1 : -1, unit.name);
}

std::string anticipated_line(double q) {
    return upright(q, "back lw 1.3 dt (9,7) lc rgb '#7A5200'") +
           fmt::format("set label 2 'anticipated' at first {:.9g},graph 0.96 left offset 0.7,0 "
                       "font ',10' textcolor '#7A5200'\n",
                       q);
}

} // namespace

Figure level1_figure(const model::Case &scene, const results::Level1 &level1, const Units &) {
    constexpr int height = 520;
    constexpr double pixel = 1.0 / height;
    const StiffnessUnit unit =
        unit_of(std::max(level1.q.empty() ? 0 : level1.q.back(), level1.anticipated.value_or(0)));
    const std::vector<PlotPoint> points = points_over(level1.q, 1 / unit.size, level1.log_dec, 1);
    double low = 0;
    double high = 0;
    for (const double log_dec : level1.log_dec)
        if (std::isfinite(log_dec)) {
            low = std::min(low, log_dec);
            high = std::max(high, log_dec);
        }
    const double margin = high > low ? 0.08 * (high - low) : 0.1;
    double largest = points.empty() || points.back().x <= 0 ? 1 : points.back().x;
    largest = std::max(largest, 1.02 * level1.anticipated.value_or(0) / unit.size);
    Curves drawn;
    drawn.add(points, "with lines lw 2.2 lc rgb '#0072B2'");
    std::string panel =
        panel_margins(0.1, 0.96, 70 * pixel, 1 - 80 * pixel) +
        axes_over({0, largest}, {low - margin, high + margin}) + grid +
        fmt::format("set xlabel 'Added cross coupling Q = k_{{xy}} = −k_{{yx}} ({})' enhanced\n"
                    "set ylabel 'Logarithmic decrement'\n"
                    "set xzeroaxis lt 1 lw 1.2 lc rgb '#555555'\nunset key\n"
                    "set object rectangle from graph 0,graph 0 to graph 1,first 0 behind fs solid "
                    "noborder fc rgb '#FBE3EA'\n"
                    "set label 3 'grows' at graph 0.01,first {:.9g} left font ',10' textcolor "
                    "'#B0305C'\n",
                    unit.name, low - 0.4 * margin);
    if (const auto &root = level1.critical_cross_coupling; root && *root / unit.size <= largest)
        panel += root_mark(*root / unit.size, largest, unit);
    if (level1.anticipated)
        panel += anticipated_line(*level1.anticipated / unit.size);
    return figure_of(1080, height, "Level-I stability: " + title_of(scene),
                     fmt::format("at {} rpm, cross coupling Q added at z = {} m",
                                 readable(level1.speed * rpm, 6), readable(level1.z, 5)),
                     panel + drawn.script());
}

} // namespace whirl::report
