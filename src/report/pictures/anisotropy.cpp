#include "report/pictures/figures.h"

#include "report/pictures/style.h"
#include "results/show.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace whirl::report {

namespace {

using results::AnisotropyChart;

constexpr const char *limit_look = "with lines lw 2 lc rgb '#B00020'";
constexpr const char *critical_look = "with lines lw 1.8 dt (12,5) lc rgb '#0072B2'";
constexpr const char *case_look = "lc rgb '#444444' dt (6,4) front";

/// Speeds in rad/s on the left, as the panel has them, and in the unit of readers on the right;
/// there alone where it was asked for.
std::string speed_axes(const Units &units, const AnisotropyChart &chart) {
    const bool asked = units.asked(Quantity::speed);
    return fmt::format("set yrange [0:{}]\n{}"
                       "set y2range [0:{}]\nset y2tics\nset y2label {}\n"
                       "set grid lc rgb '#E4E4E4' lt 1\nset key bottom right opaque\n",
                       chart.speed.back(),
                       asked ? std::string("unset ytics\n")
                             : "set ytics nomirror\nset ylabel " +
                                   axis_text({}, "Spin speed", Quantity::speed) + "\n",
                       units(Quantity::speed, chart.speed.back()),
                       asked ? axis_text(units, "Spin speed", Quantity::speed)
                             : plot_text(units.name(Quantity::speed)));
}

std::string mark(double x, double y, const char *text) {
    return fmt::format("set label '{}' at {},{} center front font ',20' textcolor '#444444'\n",
                       text, x, y);
}

/// Anisotropy up to which the axis runs: the case's and the permissible one in its middle.
double widest_anisotropy(const AnisotropyChart &chart) {
    return std::min(1.0, std::max({2.2 * chart.anisotropy, 3 * chart.permissible, 0.05}));
}

/// Where (+) and (-) stand in the panel over anisotropy.
std::string signs_over_anisotropy(const AnisotropyChart &chart, double widest) {
    std::string text = mark(0.12 * widest, 0.9 * chart.speed.back(), "+");
    const double at = 0.85 * widest;
    double low = 0;
    double high = 0;
    for (std::size_t i = 0; i < chart.speed.size(); ++i)
        if (chart.limit[i] < at) {
            low = low == 0 ? chart.speed[i] : low;
            high = chart.speed[i];
        }
    return high > low ? text + mark(at, (low + high) / 2, "−") : text;
}

/// The region right of the limit curve is unstable.
std::string anisotropy_panel(const Units &units, const AnisotropyChart &chart) {
    const double widest = widest_anisotropy(chart);
    std::vector<PlotPoint> region;
    for (std::size_t i = 0; i < chart.speed.size(); ++i)
        region.push_back({std::min(chart.limit[i], widest), chart.speed[i]});
    region.push_back({widest, chart.speed.back()});
    region.push_back({widest, 0});
    Curves drawn;
    drawn.add(region, "with filledcurves closed lc rgb '#F6D5D0'", "'unstable (−)'");
    drawn.add(points_over(chart.limit, 1, chart.speed, 1), limit_look, "'stability limit'");
    drawn.add(points_over(chart.undamped, 1, chart.speed, 1), critical_look, "'critical speed'");
    return speed_axes(units, chart) + signs_over_anisotropy(chart, widest) +
           fmt::format("set title 'C = {:.4g} (upright line: the case)'\nset xlabel 'Anisotropy, "
                       "half the difference of the diametral inertias / A'\nset xrange [0:{}]\n",
                       chart.C, widest) +
           upright(chart.anisotropy, case_look) + drawn.script();
}

/// Where (+) and (-) stand in the panel over C: (-) in the middle of the band where that is widest.
std::string signs_over_polar(const AnisotropyChart &chart) {
    const double top = chart.speed.back();
    const double left = chart.polar.front();
    const double width = chart.polar.back() - left;
    double widest = 0;
    double at = 0;
    double middle = 0;
    for (std::size_t i = 0; i < chart.polar.size(); ++i) {
        const auto &band = chart.unstable_over_polar[i];
        const double to = band ? std::min(top, band->to.value_or(top)) : 0;
        if (!band || to - band->from <= widest)
            continue;
        widest = to - band->from;
        at = chart.polar[i];
        middle = (band->from + to) / 2;
    }
    std::string text =
        mark(left + 0.12 * width, 0.9 * top, "+") + mark(left + 0.9 * width, 0.12 * top, "+");
    return widest > 0.1 * top ? text + mark(at, middle, "−") : text;
}

/// Curves over C; a limit or critical speed above the axis leaves it at its upper edge.
std::string polar_panel(const Units &units, const AnisotropyChart &chart) {
    const double top = chart.speed.back();
    std::string region = "$region << EOD\n";
    std::vector<PlotPoint> lower;
    std::vector<PlotPoint> upper;
    std::vector<PlotPoint> first;
    std::vector<PlotPoint> second;
    for (std::size_t i = 0; i < chart.polar.size(); ++i) {
        const double C = chart.polar[i];
        const auto &band = chart.unstable_over_polar[i];
        const auto &speeds = chart.critical_over_polar[i];
        const bool seen = band && band->from < top;
        region +=
            seen ? fmt::format("{} {} {}\n", C, band->from, std::min(top, band->to.value_or(top)))
                 : std::string("\n");
        lower.push_back({C, band ? std::optional(band->from) : std::nullopt});
        upper.push_back({C, band ? band->to : std::nullopt});
        first.push_back({C, speeds.empty() ? std::nullopt : std::optional(speeds.front())});
        second.push_back({C, speeds.size() < 2 ? std::nullopt : std::optional(speeds.back())});
    }
    Curves drawn;
    drawn.add("$region using 1:2:3 with filledcurves lc rgb '#F6D5D0' notitle");
    drawn.add_pieces({lower, upper}, limit_look);
    drawn.add_pieces({first, second}, critical_look);
    return region + "NaN NaN NaN\nEOD\n" + speed_axes(units, chart) + signs_over_polar(chart) +
           fmt::format("set title 'anisotropy {:.4g} (upright line: the case)'\nset xlabel 'Polar "
                       "inertia C / A'\nset xrange [{}:{}]\n",
                       chart.anisotropy, chart.polar.front(), chart.polar.back()) +
           upright(chart.C, case_look) + drawn.script();
}

std::string subtitle(const Units &units, const AnisotropyChart &chart) {
    const std::string band =
        !chart.unstable ? "stable at every speed"
        : chart.unstable->to
            ? fmt::format("unstable from {} to {}",
                          drawn_number(units(Quantity::speed, chart.unstable->from)),
                          drawn_value(units, Quantity::speed, *chart.unstable->to))
            : "unstable above " + drawn_value(units, Quantity::speed, chart.unstable->from);
    return fmt::format("tilt of the rigid rotor, p = {}, h = {}; {}; stable at every "
                       "speed up to anisotropy {}",
                       drawn_value(units, Quantity::frequency, chart.p),
                       drawn_value(units, Quantity::rate, chart.h), band,
                       drawn_number(chart.permissible));
}

} // namespace

Figure anisotropy_figure(const model::Case &scene, const AnisotropyChart &chart,
                         const Units &units) {
    return figure_of(1180, 560, "Critical speeds and stability: " + title_of(scene),
                     subtitle(units, chart),
                     panel_margins(0.055, 0.41, 0.13, 0.8) + anisotropy_panel(units, chart) +
                         "unset label\nunset arrow\n" + panel_margins(0.57, 0.925, 0.13, 0.8) +
                         polar_panel(units, chart));
}

} // namespace whirl::report
