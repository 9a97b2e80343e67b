#include "report/pictures/figures.h"

#include "report/common/words.h"
#include "report/pictures/shaft_outline.h"
#include "report/pictures/style.h"
#include "results/modes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace whirl::report {

using results::ModeShape;
using results::ModesResult;

ModeCurves mode_curves(const ModeShape &mode) {
    const std::complex<double> i(0, 1);
    const std::size_t count = std::min(mode.x.size(), mode.y.size());
    std::complex<double> xx = 0;
    std::complex<double> yy = 0;
    for (std::size_t k = 0; k < count; ++k) {
        xx += mode.x[k] * mode.x[k];
        yy += mode.y[k] * mode.y[k];
    }
    // sum Re(u exp(i p))^2 = (sum |u|^2 + Re(exp(2 i p) sum u^2)) / 2 over u = x and y, or i y, is
    // largest at p = -arg(sum u^2) / 2. In one plane both ways are the same up to rounding.
    constexpr double rounding = 1e-9;
    ModeCurves curves;
    curves.at_one_instant = std::abs(xx + yy) > (1 + rounding) * std::abs(xx - yy);
    const std::complex<double> of_y = curves.at_one_instant ? 1.0 : i;
    const std::complex<double> turn = std::polar(1.0, -std::arg(xx + of_y * of_y * yy) / 2);
    double largest = 0;
    for (std::size_t k = 0; k < count; ++k) {
        curves.x.push_back((mode.x[k] * turn).real());
        curves.y.push_back((mode.y[k] * turn * of_y).real());
        for (const double value : {curves.x.back(), curves.y.back()})
            if (std::abs(value) > std::abs(largest) * (1 + rounding))
                largest = value;
        // x + i y = f exp(iwt) + conj(b) exp(-iwt): the major semi-axis is |f| + |b|.
        const double f = std::abs(mode.x[k] + i * mode.y[k]) / 2;
        const double b = std::abs(mode.x[k] - i * mode.y[k]) / 2;
        curves.envelope.push_back(f + b);
    }
    if (largest < 0) // of the two opposite instants
        for (std::vector<double> *values : {&curves.x, &curves.y})
            for (double &value : *values)
                value = -value;
    return curves;
}

namespace {

/// What follows the name and the frequency or speed of a mode.
std::string motion_words(const ModeShape &mode, const Units &units) {
    const double modulus = std::abs(mode.eigenvalue);
    const double ratio = modulus > 0 ? -mode.eigenvalue.real() / modulus : 0;
    return (std::abs(ratio) > 1e-9 ? " · damping ratio " + drawn_number(ratio, 3) : "") + " · " +
           whirl_text(mode.whirl, mode.plane, units);
}

std::string name_before(const ModeShape &mode) {
    return mode.label.empty() ? "" : mode.label + " · ";
}

/// "1F · 13.97 Hz · forward", with the damping ratio where there is damping.
/// @param largest  modulus of the eigenvalues drawn together, rad/s: what rounding is measured by
std::string mode_heading(const Units &units, const ModeShape &mode, double largest) {
    const double modulus = std::abs(mode.eigenvalue);
    const double frequency = std::abs(mode.eigenvalue.imag());
    // What is left of zero by rounding, beside its real part or the other modes, is no frequency.
    return name_before(mode) +
           (frequency > std::max(1e-9 * modulus, 1e-12 * largest)
                ? drawn_value(units, Quantity::frequency, frequency)
                : "no oscillation") +
           motion_words(mode, units);
}

/// "1F · 5721.2 rpm · forward": of the mode at a critical speed, which is its frequency.
std::string critical_heading(const Units &units, const ModeShape &mode) {
    return name_before(mode) + drawn_value(units, Quantity::speed, mode.at) +
           motion_words(mode, units);
}

constexpr double head = 120;   // pixels: above the first panels
constexpr double pitch = 238;  // from a row of panels to the next
constexpr double between = 45; // what says that critical speeds follow

/// One shape below its heading, but for the margins of the panel.
std::string shape_script(const Units &units, const ModeShape &mode, const std::string &heading,
                         const ModesResult &result) {
    const ModeCurves curves = mode_curves(mode);
    // An orbit aslant reaches farther than its parts along x and y.
    double reach = 1.25;
    for (const double value : curves.envelope)
        reach = std::isfinite(value) ? std::max(reach, 1.1 * value) : reach;
    return fmt::format(
               "set yrange [{}:{}]\nset title {} font ',12' offset 0,-0.4\n", -reach, reach,
               plot_text(heading + (curves.at_one_instant && !mode.plane // in one plane they are
                                        ? " · y at the same instant"
                                        : ""))) +
           curves_over_outline(units, result.z, curves.x, curves.y, curves.envelope, 1) +
           "unset label\n"; // gnuplot draws it with each panel
}

/// Two panels a row, the first `top` pixels above the bottom of the figure.
std::string group_script(const Units &units, const std::vector<ModeShape> &modes, double top,
                         const ModesResult &result, int height) {
    double largest = 0; // rad/s
    for (const ModeShape &mode : modes)
        largest = std::max(largest, std::abs(mode.eigenvalue));
    const bool critical = &modes == &result.critical;
    std::string script;
    for (std::size_t m = 0; m < modes.size(); ++m) {
        const double left = m % 2 == 1 ? 0.545 : 0.05;
        const double right = modes.size() == 1 ? 0.975 : left + 0.43;
        script +=
            panel_margins(left, right, (top - 175) / height, top / height) +
            (m + 2 >= modes.size() ? "set xlabel " + axis_text(units, "z", Quantity::length) + "\n"
                                   : "unset xlabel\n") +
            shape_script(units, modes[m],
                         critical ? critical_heading(units, modes[m])
                                  : mode_heading(units, modes[m], largest),
                         result);
        top -= m % 2 == 1 ? pitch : 0;
    }
    return script;
}

double rows_of(const std::vector<ModeShape> &modes) {
    const std::size_t rows = (modes.size() + 1) / 2;
    return static_cast<double>(rows);
}

} // namespace

Figure modes_figure(const model::Case &scene, const ModesResult &result, const Units &units) {
    const double rows = std::max(1.0, rows_of(result.modes));
    const double critical_rows = rows_of(result.critical);
    const int height = static_cast<int>(head + pitch * (rows + critical_rows) + 40 +
                                        (critical_rows > 0 ? between : 0));
    const double length = units(Quantity::length, std::max(scene.rotor.shaft.length(), 1e-9));
    double top = height - head;
    std::string panels = panel_margins(0.05, 0.975, 0.01, 0.02) + curve_legend(1 - 80.0 / height) +
                         outline_data(units, scene.rotor, 1) +
                         "set grid lc rgb '#EEEEEE' lt 1 lw 0.6\nset ytics -1,1,1\n" +
                         fmt::format("set xrange [{}:{}]\n", -0.03 * length, 1.03 * length) +
                         (result.modes.empty() ? "plot NaN notitle\n" : "") +
                         group_script(units, result.modes, top, result, height);
    if (!result.critical.empty()) {
        top -= pitch * rows + between;
        panels += fmt::format("set label 103 'At the critical speeds' at screen 0.5,{} center "
                              "font ',13'\n",
                              (top + 40) / height) +
                  group_script(units, result.critical, top, result, height);
    }
    return figure_of(
        1080, height, "Mode shapes: " + title_of(scene),
        fmt::format("at {}{}; the orbits' envelope, x where most is seen, y a quarter period "
                    "later (equal curves: forward, mirrored: backward)",
                    drawn_value(units, Quantity::speed, result.speed),
                    result.critical.empty() ? "" : " and at the critical speeds"),
        panels);
}

} // namespace whirl::report
