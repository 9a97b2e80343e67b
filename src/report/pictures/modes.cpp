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

} // namespace

std::vector<std::string> mode_headings(const std::vector<ModeShape> &modes, const Units &units,
                                       bool critical) {
    double largest = 0; // rad/s
    for (const ModeShape &mode : modes)
        largest = std::max(largest, std::abs(mode.eigenvalue));
    std::vector<std::string> headings;
    for (const ModeShape &mode : modes) {
        const double modulus = std::abs(mode.eigenvalue);
        const double frequency = std::abs(mode.eigenvalue.imag());
        // What is left of zero by rounding, beside its real part or the other modes, is none.
        const bool swings = frequency > std::max(1e-9 * modulus, 1e-12 * largest);
        headings.push_back((mode.label.empty() ? "" : mode.label + " · ") +
                           (critical ? "critical at " + drawn_value(units, Quantity::speed, mode.at)
                            : swings ? drawn_value(units, Quantity::frequency, frequency)
                                     : "no oscillation") +
                           motion_words(mode, units));
    }
    return headings;
}

Chart modes_chart(const model::Case &scene, const ModesResult &result, const Units &units) {
    Chart chart{
        "Mode shapes: " + title_of(scene),
        fmt::format("at {}{}; the orbits' envelope, x where most is seen, y a quarter period later "
                    "(equal curves: forward, mirrored: backward)",
                    drawn_value(units, Quantity::speed, result.speed),
                    result.critical.empty() ? "" : " and at the critical speeds"),
        {}};
    chart.apart = true;
    for (const std::vector<ModeShape> *modes : {&result.modes, &result.critical}) {
        const auto headings = mode_headings(*modes, units, modes == &result.critical);
        for (std::size_t m = 0; m < modes->size(); ++m) {
            const ModeShape &mode = (*modes)[m];
            const ModeCurves curves = mode_curves(mode);
            ChartPanel panel{160,
                             along_shaft(units, scene.rotor),
                             {.step = 1},
                             curves_over_outline(units, scene.rotor, result.z, curves.x, curves.y,
                                                 curves.envelope, 1, 1),
                             headings[m]};
            if (curves.at_one_instant && !mode.plane) // in one plane they are
                panel.title += " · y at the same instant";
            // An orbit aslant reaches farther than its parts along x and y.
            double reach = 1.25;
            for (const double value : curves.envelope)
                reach = std::isfinite(value) ? std::max(reach, 1.1 * value) : reach;
            panel.y.low = -reach;
            panel.y.high = reach;
            panel.beside = m % 2 == 1;
            chart.panels.push_back(std::move(panel));
        }
    }
    return chart;
}

} // namespace whirl::report
