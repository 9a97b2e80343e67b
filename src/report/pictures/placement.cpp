#include "report/pictures/figures.h"

#include "report/pictures/operation.h"
#include "report/pictures/shaft_outline.h"
#include "report/pictures/style.h"
#include "results/balance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace whirl::report {

namespace {

/// Blue-green below zero (balances), orange above, white at zero; readable without colour by the
/// black line at zero.
constexpr const char *palette =
    "set palette defined (-1 '#00543C', -0.35 '#4DB08C', -0.02 '#E9F5F0', 0.02 '#FBEDE3', "
    "0.35 '#EE9A5C', 1 '#A34400')\nset cbrange [-1:1]\n";

/// Values to be drawn: 1 and -1 are a free rigid body's; beyond that colour says nothing more.
std::string matrix_block(const std::string &name, const std::vector<double> &x,
                         const std::vector<double> &y,
                         const std::vector<std::vector<double>> &values) {
    std::string block = "$" + name + " << EOD\n";
    for (std::size_t j = 0; j < y.size(); ++j) {
        for (std::size_t i = 0; i < x.size(); ++i)
            block +=
                fmt::format("{:.6g} {:.6g} {:.5g}\n", x[i], y[j], std::tanh(1.5 * values[j][i]));
        block += "\n";
    }
    return block + "EOD\n";
}

/// The sign alone, for the line between balanced and unbalanced.
std::string heat_plot(const std::string &name) {
    return fmt::format("plot ${0} using 1:2:3 with image notitle, ${0}line with lines lc rgb "
                       "'#000000' lw 1.6 notitle",
                       name);
}

std::string contour(const std::string &name, const std::string &target) {
    return fmt::format("set table {1}\nset contour base\nset cntrparam levels discrete 0\n"
                       "unset surface\nsplot {0} using 1:2:3 with lines notitle\nunset table\n"
                       "unset contour\nset surface\n",
                       name, target);
}

/// Outline of shaft and discs below z = 0 of an axis, bearings as triangles.
std::string rotor_panel(const model::Case &scene) {
    const auto &rotor = scene.rotor;
    const double length = rotor.shaft.length();
    std::vector<PlotPoint> upper;
    double widest = 0;
    for (int i = 0; i <= 400; ++i) {
        const double z = length * i / 400;
        const double radius = shaft_radius(rotor.shaft, z);
        upper.push_back({z * metres, radius});
        widest = std::max(widest, radius);
    }
    const double thickest = widest;
    std::string discs;
    for (const auto &disc : rotor.discs) {
        const double radius = disc.outer > 0 ? disc.outer / 2 : 3 * thickest;
        widest = std::max(widest, radius);
        const double half = std::max(disc.width / 2, 0.006 * length);
        discs += fmt::format("set object rectangle from first {},{} to first {},{} fillcolor rgb "
                             "'#8FA3B5' fillstyle solid border lc rgb '#44525F' front\n",
                             (disc.z - half) * metres, -radius, (disc.z + half) * metres, radius);
    }
    std::vector<PlotPoint> bearings;
    for (const auto &bearing : rotor.supports())
        bearings.push_back(
            {bearing.z * metres, -shaft_radius(rotor.shaft, bearing.z) - 0.25 * widest});
    Curves drawn;
    drawn.add(upper, "using 1:2:(-$2) with filledcurves lc rgb '#C5D0DA'");
    drawn.add(bearings, "with points pt 9 ps 2 lc rgb '#333333'");
    return discs +
           fmt::format("set yrange [{}:{}]\nunset ytics\nset border 0\nset xtics nomirror\n",
                       -1.5 * widest, 1.1 * widest) +
           drawn.script() + "set border 31\nset ytics\nset xtics mirror\nunset object\n";
}

std::vector<double> scaled(std::vector<double> values, double factor) {
    for (double &value : values)
        value *= factor;
    return values;
}

std::string best_marks(const std::vector<double> &z, double low, double high) {
    std::string out;
    for (const double at : z)
        out +=
            fmt::format("set arrow from first {0:.9g},{1:.9g} to first {0:.9g},{2:.9g} nohead lw "
                        "4 lc rgb '#FFFFFF' front\nset arrow from first {0:.9g},{1:.9g} to first "
                        "{0:.9g},{2:.9g} nohead lw 2 dt (8,4) lc rgb '#5B2A86' front\n",
                        at, low, high);
    return out;
}

std::string best_place_text(const results::BestPlace &place) {
    std::string text;
    for (const double z : place.z)
        text += (text.empty() ? "z = " : " and ") + readable(z, 4);
    return text + (place.share > 0 ? fmt::format(" m: {:.0f} % of the speeds", 100 * place.share)
                                   : std::string(" m, the least bad"));
}

/// The panel of two planes, with a cross at the best two.
std::string two_planes(const results::Placement &map, double length, double pixel) {
    return panel_margins(0.575, 0.985, 1 - 585 * pixel, 1 - 100 * pixel) +
           fmt::format(
               "set yrange [0:{}]\nset ylabel 'z of the other plane (m)'\nset xlabel 'z of one "
               "plane (m)'\nset label 1 {} at graph 0,1.03 left\nset label 2 {} at screen 0.575,{} "
               "left\n"
               "set label 4 {} at screen 0.575,{} left\n",
               length,
               plot_text(fmt::format("two planes at {} rpm", readable(map.pair_speed * rpm))),
               plot_text(map.best_pair.share > 0 ? "cross: best two over all speeds,"
                                                 : "no two balance at any of the speeds; cross:"),
               1 - 665 * pixel, plot_text(best_place_text(map.best_pair)), 1 - 685 * pixel) +
           (map.best_pair.z.size() == 2
                ? fmt::format("set label 3 '' at first {0:.9g},{1:.9g} point pt 7 ps 2.6 lc rgb "
                              "'#FFFFFF' front\nset label 5 '' at first {0:.9g},{1:.9g} point pt 2 "
                              "ps 2 lw 2 lc rgb '#5B2A86' front\n",
                              map.best_pair.z[0] * metres, map.best_pair.z[1] * metres)
                : "") +
           heat_plot("two");
}

} // namespace

Figure placement_figure(const model::Case &scene, const results::Placement &map, const Units &) {
    constexpr int height = 760;
    constexpr double pixel = 1.0 / height;
    const std::vector<double> speeds = scaled(map.speeds, rpm);
    const double length = scene.rotor.shaft.length() * metres;
    // A speed alone has no area: its colours go up to the edge of the panel, 1 rpm higher.
    std::vector<double> drawn_speeds = speeds;
    auto drawn = map.criterion;
    if (speeds.size() == 1) {
        drawn_speeds.push_back(speeds.front() + 1);
        drawn.push_back(drawn.front());
    }
    return figure_of(
        1180, height, "Where along the shaft auto-balancers work: " + title_of(scene),
        "green: balances; orange: does not; dark: as strongly as a free rigid body",
        palette + matrix_block("one", scaled(map.z, metres), drawn_speeds, drawn) +
            matrix_block("two", scaled(map.pair_z, metres), scaled(map.pair_z, metres),
                         map.pair_value) +
            (speeds.size() > 1 ? contour("$one", "$oneline") : "$oneline << EOD\nNaN NaN\nEOD\n") +
            contour("$two", "$twoline") +
            fmt::format("unset colorbox\nset xrange [0:{}]\nset format x ''\n", length) +
            panel_margins(0.09, 0.5, 1 - 585 * pixel, 1 - 100 * pixel) +
            fmt::format(
                "set yrange [{}:{}]\nset ylabel 'Spin speed (rpm)'\nset label 1 {} at graph "
                "0,1.03 left\n",
                speeds.front(), speeds.size() > 1 ? speeds.back() : speeds.front() + 1,
                plot_text("one plane; best (dashed) " + best_place_text(map.best))) +
            best_marks(scaled(map.best.z, metres), speeds.front(), speeds.back()) +
            operation_lines(scene, {speeds.front(), speeds.back()}, SpeedAxis::y) +
            heat_plot("one") +
            "\nunset object\nunset arrow\nunset ylabel\nunset label\nset format x '%g'\n"
            "set xlabel 'z (m)'\n" +
            panel_margins(0.09, 0.5, 60 * pixel, 1 - 600 * pixel) + rotor_panel(scene) +
            two_planes(map, length, pixel) + "\n");
}

} // namespace whirl::report
