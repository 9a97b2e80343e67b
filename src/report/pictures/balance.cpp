#include "report/common/text_width.h"
#include "report/pictures/figures.h"

#include "report/pictures/style.h"
#include "results/balance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace whirl::report {

using results::BalanceBands;
using results::BalanceResult;
using results::SignaturePoint;

namespace {

constexpr const char *balanced_colour = "#007D5A";
constexpr const char *rigid_colour = "#A9B4BF";
constexpr const char *stable_colour = "#0072B2";
constexpr const char *light_colour = "#56B4E9";
constexpr const char *some_colour = "#A6CBE3";
constexpr const char *unbalanced_colour = "#D55E00";
constexpr const char *undecided_colour = "#7A7A7A";

/// The panel of the bands: a row for each plane, for all of them, for balancers of little mass, for
/// the real ones and for motions in time. The first one lies from -1 to 0, the next below it.
class BandRows {
  public:
    BandRows(const BalanceResult &result, const Units &units, ChartPanel &panel)
        : _units(units), _panel(panel) {
        for (std::size_t i = 0; i < result.planes.size(); ++i) {
            const auto &plane = result.planes[i];
            const std::string name =
                plane.name.empty() ? "plane " + std::to_string(i + 1) : plane.name;
            constexpr double most = 280; // pixels
            add_bands(fitting(name, picture_font, most) +
                          ", z = " + drawn_value(units, Quantity::length, plane.z, 4),
                      plane.bands);
        }
        if (result.planes.size() > 1)
            add_bands("all planes together", result.joint.bands);
        if (result.first_order) {
            begin("light balancers stable");
            main_bars(result.first_order->bands, "first order in the balancers' mass",
                      light_colour);
        }
        if (const auto &position = result.balanced_position) {
            begin("real balancers stable");
            bars(position->with_some, "stable with some arrangement of the balls", 0.42, 0.74,
                 some_colour);
            if (position->with_some.empty() || !position->bands.empty())
                main_bars(position->bands, "balanced position stable", stable_colour);
        }
        if (!result.simulated.empty()) {
            begin("motions in time");
            outcomes(result.simulated, "balanced", "in time: balanced", stable_colour, 7);
            outcomes(result.simulated, "", "in time: not", unbalanced_colour, 2);
            outcomes(result.simulated, "undecided", "in time: undecided", undecided_colour, 6);
        }
        panel.y.low = _base;
        panel.y.high = 0.35; // room for the numbers of the first row
        panel.height = static_cast<int>(74 * (0.35 - _base));
    }

  private:
    void begin(const std::string &name) {
        _base -= 1;
        _panel.y.names.emplace_back(_base + 0.5, name);
    }

    void bars(const std::vector<results::Interval> &bands, const std::string &name, double low,
              double high, const char *colour) {
        for (const auto &band : bands) {
            const double from = _units(Quantity::speed, band.from);
            const double to = _units(Quantity::speed, band.to);
            ChartCurve bar = chart_bar({from, to}, {_base + low, _base + high}, {name, colour});
            bar.texts = {
                name + ": " +
                _units.text(model::Sentence("{}", model::as::speed.range(band.from, band.to, 10)))};
            _panel.curves.push_back(std::move(bar));
        }
    }

    /// The word `nowhere` at the left without any.
    void main_bars(const std::vector<results::Interval> &bands, const std::string &name,
                   const char *colour) {
        bars(bands, name, 0.42, 0.74, colour);
        if (bands.empty())
            _panel.labels.push_back(
                {"nowhere in this range", *_panel.x.low, _base + 0.58, "#777777"});
    }

    /// With the ends of the bands as numbers above their bars, where neighbours leave room.
    void add_bands(const std::string &name, const BalanceBands &of) {
        begin(name);
        main_bars(of.bands, "criterion", balanced_colour);
        if (of.rigid_bands)
            bars(*of.rigid_bands, "rigid form", 0.2, 0.36, rigid_colour);
        for (const auto &end : of.ends)
            _panel.labels.push_back(
                {drawn_speed(_units, end.speed), _units(Quantity::speed, end.speed), _base + 0.8});
    }

    /// @param outcome  empty: neither balanced nor undecided
    void outcomes(const std::vector<results::SimulatedSpeed> &runs, const std::string &outcome,
                  const std::string &name, const char *colour, int point) {
        ChartCurve marks{name, {}, {"", colour, "1", point}, 0, 1.3};
        for (const auto &run : runs) {
            const bool other = run.outcome != "balanced" && run.outcome != "undecided";
            if (outcome.empty() ? !other : run.outcome != outcome)
                continue;
            marks.points.push_back({_units(Quantity::speed, run.speed), _base + 0.5});
            std::string text = _units.text(Quantity::speed, run.speed, 7) + ": " + run.outcome;
            if (run.residual_ratio)
                text += "\nleft of the amplitude: " + readable(*run.residual_ratio, 3);
            if (run.growth)
                text += "\ngrowth about balance: " + _units.text(Quantity::rate, *run.growth, 3);
            marks.texts.push_back(text);
        }
        if (!marks.points.empty() || outcome != "undecided")
            _panel.curves.push_back(std::move(marks));
    }

    const Units &_units;
    ChartPanel &_panel;
    double _base = 0; ///< of the row
};

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

void name_powers(double unit, double largest, ChartAxis &axis) {
    axis.names.emplace_back(0, "0");
    const int first = static_cast<int>(std::lround(std::log10(unit))) + 1;
    const int last = static_cast<int>(std::ceil(std::log10(largest)));
    const int step = std::max(1, (last - first) / 4);
    for (int power = first; power <= last; power += step)
        for (const double sign : {1.0, -1.0})
            axis.names.emplace_back(folded(sign * std::pow(10, power), unit),
                                    (sign < 0 ? "−" : "") +
                                        with_powers(fmt::format("1e{:+03d}", power)));
}

/// All of an eigenvalue of the joint form, for the page.
std::string all_of(const Units &units, const SignaturePoint &point, std::size_t k, double mass) {
    return fmt::format(
        "{}\neigenvalue {}: {}\n× mass: {}\n{} of {} negative\n"
        "imbalances of the largest: {}",
        units.text(Quantity::speed, point.speed, 7), k + 1,
        units.text(Quantity::inverse_mass, point.eigenvalues[k]),
        readable(point.eigenvalues[k] * mass, 6), point.negative, point.eigenvalues.size(),
        joined(point.worst, ", ", [](const auto &part) { return readable(part.real(), 3); }));
}

/// Polylines of the eigenvalues, cut where a critical speed lies between two speeds.
/// @param sign  of those that are drawn; 0: all
void add_eigenvalues(const Units &units, const BalanceResult &result, double mass, double unit,
                     int sign, ChartPanel &panel) {
    const auto &points = result.joint.signature;
    const std::size_t count = points.empty() ? 0 : points.front().eigenvalues.size();
    for (std::size_t k = 0; k < count; ++k) {
        ChartCurve line{sign < 0   ? "negative"
                        : sign > 0 ? "positive"
                                   : "",
                        {},
                        {"",
                         sign < 0   ? balanced_colour
                         : sign > 0 ? unbalanced_colour
                                    : "#B5B5B5",
                         "1"},
                        sign == 0 ? 1.2 : 2,
                        sign == 0 ? 0 : 0.3};
        const auto add = [&](double speed, std::optional<double> value, const std::string &text) {
            line.points.push_back({units(Quantity::speed, speed), value});
            if (sign != 0)
                line.texts.push_back(text);
        };
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (i > 0 && std::ranges::any_of(result.critical_speeds, [&](double c) {
                    return c >= points[i - 1].speed && c < points[i].speed;
                }))
                add(points[i].speed, std::nullopt, "");
            const double value = mass * points[i].eigenvalues[k];
            const bool shown = sign == 0 || (sign < 0) == (value < 0);
            add(points[i].speed, shown ? std::optional(folded(value, unit)) : std::nullopt,
                all_of(units, points[i], k, mass));
        }
        panel.curves.push_back(std::move(line));
    }
}

ChartPanel signature_panel(const Units &units, const BalanceResult &result, const ChartAxis &x) {
    const double mass = result.rigid ? result.rigid->mass : units.factor(Quantity::inverse_mass);
    const double unit = unit_of(result, mass);
    double largest = 10 * unit;
    for (const SignaturePoint &point : result.joint.signature)
        for (const double value : point.eigenvalues)
            largest = std::max(largest, std::min(std::abs(value) * mass, 1e3));
    ChartPanel panel{350,
                     x,
                     {.title = result.rigid ? "Eigenvalues × mass of the rotor"
                                            : units.label("Eigenvalues", Quantity::inverse_mass)},
                     {}};
    panel.y.high = 1.05 * folded(largest, unit);
    panel.y.low = -*panel.y.high;
    name_powers(unit, largest, panel.y);
    panel.curves.push_back(level_line(panel, 0, {"", "#555555", "1"}));
    for (const int sign : {0, -1, 1})
        add_eigenvalues(units, result, mass, unit, sign, panel);
    return panel;
}

} // namespace

Chart balance_chart(const model::Case &scene, const BalanceResult &result, const Units &units) {
    Chart chart{"Where auto-balancers work: " + title_of(scene),
                "the empirical criterion beside the rigid closed form, the real balancers at their "
                "balanced position, and motions in time; numbers: ends in " +
                    units.name(Quantity::speed),
                {}};
    const ChartAxis x = along_speeds(units, result.speeds);
    ChartPanel bands{0, x, {}, {}};
    const BandRows rows(result, units, bands);
    if (bands.y.names.empty())
        return chart;
    for (const double critical : result.critical_speeds)
        bands.curves.push_back(upright_line(bands, units(Quantity::speed, critical),
                                            {"critical speed", "#777777", "(4,4)"}));
    chart.panels = {bands, signature_panel(units, result, x)};
    return chart;
}

} // namespace whirl::report
