#include "report/pictures/figures.h"
#include "report/pictures/mode_curves.h"

#include "report/pictures/shaft_outline.h"
#include "report/pictures/style.h"
#include "results/modes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace whirl::report {

using results::ModeShape;
using results::ModesResult;

namespace {

std::string mode_data(const std::string &name, const ModesResult &result,
                      const ModeCurves &curves) {
    std::string data = "$" + name + " << EOD\n";
    const std::size_t count = std::min(result.z.size(), curves.x.size());
    for (std::size_t i = 0; i < count; ++i)
        data += fmt::format("{:.7g} {} {} {}\n", result.z[i] * metres, plot_number(curves.x[i]),
                            plot_number(curves.y[i]), plot_number(curves.envelope[i]));
    return data + (count == 0 ? "NaN NaN NaN NaN\n" : "") + "EOD\n";
}

} // namespace

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

std::string mode_heading(const ModeShape &mode, double largest) {
    const double modulus = std::abs(mode.eigenvalue);
    const double frequency = std::abs(mode.eigenvalue.imag());
    std::string heading = mode.label.empty() ? "" : mode.label + " · ";
    // What is left of zero by rounding, beside its real part or the other modes, is no frequency.
    heading += frequency > std::max(1e-9 * modulus, 1e-12 * largest)
                   ? readable(frequency * hertz) + " Hz"
                   : "no oscillation";
    const double ratio = modulus > 0 ? -mode.eigenvalue.real() / modulus : 0;
    if (std::abs(ratio) > 1e-9)
        heading += " · damping ratio " + readable(ratio, 3);
    return heading + " · " + whirl_style(mode.whirl).name;
}

Figure modes_figure(const model::Case &scene, const ModesResult &result) {
    const std::size_t count = std::max<std::size_t>(1, result.modes.size());
    const std::size_t columns = count > 1 ? 2 : 1;
    const std::size_t rows = (count + columns - 1) / columns;
    Figure figure;
    figure.width = 1080;
    figure.height = static_cast<int>(120 + 230 * rows + 40);
    const double pixel = 1.0 / figure.height;
    figure.script = figure_head(
        "Mode shapes: " + title_of(scene),
        fmt::format("at {} rpm; the orbits' envelope, x where most is seen, y a quarter period "
                    "later (equal curves: forward, mirrored: backward)",
                    readable(result.speed * rpm)),
        figure.height);
    const double length = std::max(scene.rotor.shaft.length(), 1e-9) * metres;
    figure.script += panel_margins(0.05, 0.975, 0.01, 0.02) + curve_legend(1 - 80 * pixel);
    figure.script += outline_data(scene.rotor, 1) +
                     "set grid lc rgb '#EEEEEE' lt 1 lw 0.6\nset ytics -1,1,1\n" +
                     fmt::format("set xrange [{}:{}]\n", -0.03 * length, 1.03 * length);
    double largest = 0; // rad/s
    for (const ModeShape &mode : result.modes)
        largest = std::max(largest, std::abs(mode.eigenvalue));
    for (std::size_t m = 0; m < result.modes.size(); ++m) {
        const ModeShape &mode = result.modes[m];
        const double left = columns == 1 || m % 2 == 0 ? 0.05 : 0.545;
        const double right = columns == 1 ? 0.975 : left + 0.43;
        const std::size_t row = m / columns;
        const double top = figure.height - 120.0 - 230.0 * static_cast<double>(row);
        const std::string name = "m" + std::to_string(m);
        const bool last = m + columns >= count;
        const ModeCurves curves = mode_curves(mode);
        // An orbit aslant reaches farther than its parts along x and y.
        double reach = 1.25;
        for (const double value : curves.envelope)
            reach = std::isfinite(value) ? std::max(reach, 1.1 * value) : reach;
        figure.script +=
            fmt::format("set yrange [{}:{}]\n", -reach, reach) + mode_data(name, result, curves) +
            panel_margins(left, right, (top - 175) * pixel, top * pixel) +
            fmt::format("set title {} font ',12' offset 0,-0.4\n{}\n",
                        plot_text(mode_heading(mode, largest) +
                                  (curves.at_one_instant ? " · y at the same instant" : "")),
                        last ? "set xlabel 'z (m)'" : "unset xlabel");
        figure.script += curves_over_outline(name);
    }
    figure.script += result.modes.empty() ? "plot NaN notitle\n" : "";
    figure.script += "unset multiplot\n";
    return figure;
}

} // namespace whirl::report
