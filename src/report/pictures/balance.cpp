#include "report/common/text_width.h"
#include "report/pictures/figures.h"

#include "report/pictures/operation.h"
#include "report/pictures/style.h"
#include "results/balance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace whirl::report {

using results::BalanceResult;

namespace {

constexpr const char *balanced_colour = "#007D5A";
constexpr const char *rigid_colour = "#A9B4BF";
constexpr const char *stable_colour = "#0072B2";
constexpr const char *some_colour = "#A6CBE3";
constexpr const char *unbalanced_colour = "#D55E00";

/// plot_text for a tic: without the word that tics do not take (they get it for all together), and
/// with percent signs doubled, which are formats of numbers there.
std::string tic_text(const std::string &text) {
    std::string doubled;
    for (const char letter : text)
        doubled += letter == '%' ? std::string("%%") : std::string(1, letter);
    const std::string whole = plot_text(doubled);
    return whole.substr(0, whole.rfind(' '));
}

std::string bars(const Units &units, const std::vector<results::Interval> &bands, double low,
                 double high, const char *colour) {
    std::string out;
    for (const auto &band : bands)
        out += fmt::format("set object rectangle from first {:.9g},{} to first {:.9g},{} "
                           "fillcolor rgb '{}' fillstyle solid noborder front\n",
                           units(Quantity::speed, band.from), low, units(Quantity::speed, band.to),
                           high, colour);
    return out;
}

/// Ends of the bands as numbers above their bars, where neighbours leave room.
std::string end_labels(const Units &units, const results::BalanceBands &bands, double y,
                       double width) {
    std::string out;
    double last = -1e300;
    for (const auto &end : bands.ends) {
        const double x = units(Quantity::speed, end.speed);
        if (x - last < 0.055 * width)
            continue;
        out +=
            fmt::format("set label '{:.0f}' at first {:.9g},{} center font ',9' front\n", x, x, y);
        last = x;
    }
    return out;
}

constexpr const char *undecided_colour = "#7A7A7A";

/// A mark for each motion in time: a full one where it ends balanced, an empty one where that is
/// not decided, else a cross.
std::string outcome_marks(const Units &units, const std::vector<results::SimulatedSpeed> &runs,
                          double y) {
    std::string out;
    for (const auto &run : runs) {
        const bool balanced = run.outcome == "balanced";
        const bool undecided = run.outcome == "undecided";
        out += fmt::format("set label '' at first {:.9g},{} point pt {} ps 1.3 lc rgb '{}' front\n",
                           units(Quantity::speed, run.speed), y,
                           balanced    ? 7
                           : undecided ? 6
                                       : 2,
                           balanced    ? stable_colour
                           : undecided ? undecided_colour
                                       : unbalanced_colour);
    }
    return out;
}

/// What the marks of the upper panel mean: those that are drawn.
Curves bands_key(const BalanceResult &result) {
    Curves key;
    const auto add_box = [&key](const char *colour, const char *title) {
        key.add(fmt::format("NaN with boxes fs solid lc rgb '{}' title '{}'", colour, title));
    };
    add_box(balanced_colour, "criterion");
    add_box(rigid_colour, "rigid form");
    if (result.balanced_position)
        add_box(stable_colour, "real balancers");
    if (!result.simulated.empty())
        key.add(fmt::format("NaN with points pt 7 ps 1.3 lc rgb '{}' title 'in time: balanced', "
                            "NaN with points pt 2 ps 1.3 lc rgb '{}' title 'not'",
                            stable_colour, unbalanced_colour));
    if (std::ranges::any_of(result.simulated,
                            [](const auto &run) { return run.outcome == "undecided"; }))
        key.add(fmt::format("NaN with points pt 6 ps 1.3 lc rgb '{}' title 'undecided'",
                            undecided_colour));
    if (!result.critical_speeds.empty())
        key.add("NaN with lines dt (4,4) lc rgb '#777777' title 'critical speed'");
    return key;
}

/// The bars of a row; the word `nowhere` at its left without any.
std::string main_bars(const Units &units, const std::vector<results::Interval> &bands, double base,
                      const char *colour) {
    if (bands.empty())
        return fmt::format("set label 'nowhere in this range' at graph 0.01,first {} left "
                           "textcolor '#777777' font ',9' front\n",
                           base + 0.58);
    return bars(units, bands, base + 0.42, base + 0.74, colour);
}

/// A row of the upper panel; the first one lies from -1 to 0, the next below it.
struct Row {
    std::string name;
    std::string marks;
};

/// @param width  of the axis of speeds
std::vector<Row> rows_of(const Units &units, const BalanceResult &result, double width) {
    std::vector<Row> rows;
    const auto base = [&rows] { return -1 - static_cast<double>(rows.size()); };
    const auto add = [&](const std::string &name, const results::BalanceBands &of) {
        std::string marks = main_bars(units, of.bands, base(), balanced_colour);
        if (of.rigid_bands)
            marks += bars(units, *of.rigid_bands, base() + 0.2, base() + 0.36, rigid_colour);
        rows.push_back({name, marks + end_labels(units, of, base() + 0.86, width)});
    };
    for (std::size_t i = 0; i < result.planes.size(); ++i) {
        const auto &plane = result.planes[i];
        const std::string name = plane.name.empty() ? "plane " + std::to_string(i + 1) : plane.name;
        constexpr double most = 280; // pixels
        add(fitting(name, picture_font, most) +
                ", z = " + drawn_value(units, Quantity::length, plane.z, 4),
            plane.bands);
    }
    if (result.planes.size() > 1)
        add("all planes together", result.joint.bands);
    if (const auto &position = result.balanced_position) {
        std::string marks =
            bars(units, position->with_some, base() + 0.42, base() + 0.74, some_colour);
        if (position->with_some.empty() || !position->bands.empty())
            marks += main_bars(units, position->bands, base(), stable_colour);
        rows.push_back({"real balancers stable", marks});
    }
    if (!result.simulated.empty())
        rows.push_back({"motions in time", outcome_marks(units, result.simulated, base() + 0.5)});
    return rows;
}

std::string bands_panel(const model::Case &scene, const Units &units, const BalanceResult &result,
                        const std::vector<Row> &rows, Range x) {
    std::string script = operation_band(scene, units, x);
    for (const double speed : result.critical_speeds)
        script += upright(units(Quantity::speed, speed), "dt (4,4) lc rgb '#777777' lw 1 back");
    std::string names;
    double middle = -0.5;
    for (const Row &row : rows) {
        names += fmt::format("{}{} {}", names.empty() ? "" : ", ", tic_text(row.name), middle--);
        script += row.marks;
    }
    Curves key = bands_key(result);
    key.add(operation_key(scene, units, x));
    return script +
           fmt::format(
               "set yrange [-{}:0]\nset ytics ({}) noenhanced\nset grid noytics\n"
               "set key at graph 1,1.02 right bottom horizontal maxrows 1 samplen 1.2 font ',9'\n",
               rows.size(), names) +
           key.script();
}

/// Linear near zero, logarithmic in modulus beyond `unit`.
double folded(double value, double unit) {
    return std::copysign(std::log10(1 + std::abs(value) / unit), value);
}

/// The power of ten below the least of the largest eigenvalues that is worth seeing.
double unit_of(const BalanceResult &result, double mass) {
    double least = 1;
    for (const auto &point : result.joint.signature)
        for (const double value : point.eigenvalues)
            if (std::abs(value) * mass > 1e-7)
                least = std::min(least, std::abs(value) * mass);
    return std::pow(10, std::floor(std::log10(least)));
}

std::string folded_tics(double unit, double largest) {
    std::string tics = "'0' 0";
    const int first = static_cast<int>(std::lround(std::log10(unit))) + 1;
    const int last = static_cast<int>(std::ceil(std::log10(largest)));
    const int step = std::max(1, (last - first) / 4);
    for (int power = first; power <= last; power += step)
        for (const double sign : {1.0, -1.0})
            tics += fmt::format(", '{}10^{{{}}}' {:.6g}", sign < 0 ? "−" : "", power,
                                folded(sign * std::pow(10, power), unit));
    return tics;
}

enum class Sign { minus, plus, any };

/// Polylines of the k-th eigenvalue, cut where a critical speed lies between two speeds.
std::vector<std::vector<PlotPoint>> eigenvalue_lines(const Units &units,
                                                     const BalanceResult &result, double factor,
                                                     double unit, Sign sign) {
    std::vector<std::vector<PlotPoint>> lines;
    const auto &points = result.joint.signature;
    const std::size_t count = points.empty() ? 0 : points.front().eigenvalues.size();
    for (std::size_t k = 0; k < count; ++k) {
        lines.emplace_back();
        for (std::size_t i = 0; i < points.size(); ++i) {
            const bool jump =
                i > 0 && std::any_of(result.critical_speeds.begin(), result.critical_speeds.end(),
                                     [&](double c) {
                                         return c >= points[i - 1].speed && c < points[i].speed;
                                     });
            if (jump)
                lines.emplace_back();
            const double value = factor * points[i].eigenvalues[k];
            const bool shown = sign == Sign::any || (sign == Sign::minus) == (value < 0);
            lines.back().push_back({units(Quantity::speed, points[i].speed),
                                    shown ? std::optional(folded(value, unit)) : std::nullopt});
        }
    }
    return lines;
}

std::string signature_panel(const model::Case &scene, const Units &units,
                            const BalanceResult &result, Range x) {
    const double mass = result.rigid ? result.rigid->mass : units.factor(Quantity::inverse_mass);
    const double unit = unit_of(result, mass);
    double largest = 10 * unit;
    for (const auto &point : result.joint.signature)
        for (const double value : point.eigenvalues)
            largest = std::max(largest, std::min(std::abs(value) * mass, 1e3));
    const double top = 1.05 * folded(largest, unit);
    Curves drawn;
    drawn.add_pieces(eigenvalue_lines(units, result, mass, unit, Sign::any),
                     "with lines lw 1.2 lc rgb '#B5B5B5'");
    drawn.add_pieces(eigenvalue_lines(units, result, mass, unit, Sign::minus),
                     fmt::format("with linespoints pt 7 ps 0.3 lw 2 lc rgb '{}'", balanced_colour),
                     "'negative'");
    drawn.add_pieces(
        eigenvalue_lines(units, result, mass, unit, Sign::plus),
        fmt::format("with linespoints pt 7 ps 0.3 lw 2 lc rgb '{}'", unbalanced_colour),
        "'positive'");
    return "unset object\nunset label\nunset arrow\n" + operation_band(scene, units, x) +
           fmt::format("set yrange [{}:{}]\nset ytics ({}) enhanced\nset ylabel {}\n"
                       "set xlabel {}\n"
                       "set key at graph 1,1.02 right bottom horizontal samplen 2\n"
                       "set arrow from graph 0,first 0 to graph 1,first 0 nohead lc rgb '#555555' "
                       "lw 1 back\n",
                       -top, top, folded_tics(unit, largest),
                       result.rigid ? plot_text("Eigenvalues × mass of the rotor")
                                    : axis_text(units, "Eigenvalues", Quantity::inverse_mass),
                       axis_text(units, "Spin speed", Quantity::speed)) +
           drawn.script();
}

} // namespace

Figure balance_figure(const model::Case &scene, const BalanceResult &result, const Units &units) {
    const Range x = speed_range(units, result.speeds);
    const std::vector<Row> rows = rows_of(units, result, x.high - x.low);
    if (rows.empty())
        return {"set xrange [0:1]\nset yrange [0:1]\nplot NaN notitle\n"};
    const double bands_height = 60.0 + 62.0 * static_cast<double>(rows.size());
    constexpr int width = 1080;
    const int height = static_cast<int>(bands_height) + 520;
    const double pixel = 1.0 / height;
    const double split = 1 - (100 + bands_height) * pixel;
    std::vector<std::string> names;
    for (const Row &row : rows)
        names.push_back(row.name);
    constexpr double beside = 20; // of a name, pixels
    const double left = std::max(0.19, (widest_text(names) + beside) / width);
    return figure_of(
        width, height, "Where auto-balancers work: " + title_of(scene),
        "the empirical criterion beside the rigid closed form, the real balancers at their "
        "balanced position, and motions in time; numbers: ends in " +
            units.name(Quantity::speed),
        fmt::format("set grid xtics lc rgb '#E4E4E4' lt 1 lw 0.6\nset xrange [{}:{}]\n", x.low,
                    x.high) +
            panel_margins(left, 0.965, split, 1 - 100 * pixel) + "set format x ''\n" +
            bands_panel(scene, units, result, rows, x) + "set format x '%g'\n" +
            panel_margins(left, 0.965, 70 * pixel, split - 55 * pixel) +
            signature_panel(scene, units, result, x));
}

} // namespace whirl::report
