#include "report/pictures/figures.h"

#include "report/common/words.h"
#include "report/pictures/style.h"
#include "results/campbell.h"
#include "results/formulation.h"
#include "results/whirl.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace whirl::report {

using results::CampbellMode;
using results::CampbellResult;
using results::Crossing;

namespace {

constexpr double log_dec_limit = 6.3; ///< higher decrements (damping ratio > 0.7) are cut off

/// An entry that the list may not have.
template <class T>
std::optional<T> entry(const std::vector<std::optional<T>> &list, std::size_t i) {
    return i < list.size() ? list[i] : std::nullopt;
}

/// Steps in which the other one of the two frequencies of a motion in rotating axes is drawn. As
/// long as it is the same one, spin speed plus or less the frequency there or the opposite of that,
/// it changes by no more than these two do.
std::vector<bool> other_of_two(const CampbellMode &mode, const std::vector<double> &speeds) {
    constexpr double rounding = 1e-6;
    std::vector<bool> out(speeds.size(), false);
    for (std::size_t i = 0; i + 1 < speeds.size(); ++i) {
        const auto here = entry(mode.frequency, i);
        const auto next = entry(mode.frequency, i + 1);
        const auto turning = entry(mode.frequency_rotating, i);
        const auto turning_next = entry(mode.frequency_rotating, i + 1);
        if (!here || !next || !turning || !turning_next)
            continue;
        const double most = speeds[i + 1] - speeds[i] + std::abs(*turning_next - *turning);
        out[i] = std::abs(*next - *here) > (1 + rounding) * most;
    }
    return out;
}

/// Two motions of a Hill series that resonate exchange their larger parts, so that a line steps
/// from the one to the other. At the beginning or end of a line, where there is no slope to compare
/// the step with, it is known by another line that steps the opposite way between the same
/// frequencies.
bool exchanged(const CampbellMode &mode, const CampbellResult &result, std::size_t i) {
    constexpr double near = 0.1; // of the step
    const auto here = entry(mode.frequency, i);
    const auto next = entry(mode.frequency, i + 1);
    if (result.model.formulation.form != results::Form::hill || !here || !next)
        return false;
    const double most = near * std::abs(*next - *here);
    return std::ranges::any_of(result.modes, [&](const CampbellMode &other) {
        const auto from = entry(other.frequency, i);
        const auto to = entry(other.frequency, i + 1);
        return &other != &mode && from && to && std::abs(*from - *next) < most &&
               std::abs(*to - *here) < most;
    });
}

double highest_of(const CampbellResult &result) {
    double highest = 0;
    for (const CampbellMode &mode : result.modes)
        for (const auto &frequency : mode.frequency)
            highest = std::max(highest, frequency.value_or(0));
    return highest;
}

/// Of a mode the steps between neighbouring speeds that are no line of a motion: its frequency
/// springs by far more than before and after. Of an anisotropic rotor a motion has two frequencies,
/// whirl and twice the spin speed less whirl, of which the larger share is drawn; and between the
/// given speeds two motions may have exchanged their places.
std::vector<bool> springs(const CampbellMode &mode, const CampbellResult &result) {
    const double highest = highest_of(result);
    const std::size_t speeds = result.speeds.size();
    constexpr double seen = 0.04; // of the highest frequency
    constexpr double more = 5;
    const auto step = [&](std::size_t i) -> std::optional<double> {
        if (i + 1 >= speeds)
            return std::nullopt;
        const auto here = entry(mode.frequency, i);
        const auto next = entry(mode.frequency, i + 1);
        return here && next ? std::optional(std::abs(*next - *here)) : std::nullopt;
    };
    std::vector<bool> sprung = other_of_two(mode, result.speeds);
    const auto large = [&](std::size_t i) { return step(i).value_or(0) > seen * highest; };
    for (std::size_t i = 0; i + 1 < speeds; ++i) {
        if (!large(i) || (i > 0 && large(i - 1)))
            continue;
        const std::size_t run = large(i + 1) ? 2 : 1; // there and back with one point between
        const auto before = i > 0 ? step(i - 1) : std::nullopt;
        const auto after = step(i + run); // one of them is missing at an end of the range
        const double usual = std::max(before.value_or(0), after.value_or(0));
        for (std::size_t k = i; (before || after) && k < i + run; ++k)
            sprung[k] = sprung[k] || (!large(i + run) && *step(k) > more * usual);
        if (!before && !after)
            sprung[i] = sprung[i] || exchanged(mode, result, i);
    }
    return sprung;
}

/// Speeds of a mode, from the first to the last, between which its line goes on.
struct Stretch {
    std::size_t from, to;
};

/// The stretches where a mode has values and stays what it is.
/// @param sprung  of its steps
template <class Value, class Kind>
std::vector<Stretch> stretches(const std::vector<bool> &sprung, const Value &value,
                               const Kind &kind) {
    std::vector<Stretch> out;
    for (std::size_t i = 0; i < sprung.size(); ++i) {
        if (!value(i))
            continue;
        const bool on = i > 0 && !out.empty() && out.back().to + 1 == i && !sprung[i - 1];
        if (on && kind(i) == kind(i - 1))
            out.back().to = i;
        else
            out.push_back({i, i});
    }
    return out;
}

/// What a panel shows over the spin speed.
struct CampbellView {
    const CampbellResult &result;
    const Units &units;
    bool damping;

    [[nodiscard]] std::optional<double> value(const CampbellMode &mode, std::size_t i) const {
        const auto value = entry(damping ? mode.log_dec : mode.frequency, i);
        return value && !damping ? std::optional(units(Quantity::frequency, *value)) : value;
    }
    [[nodiscard]] PlotPoint point(const CampbellMode &mode, std::size_t i) const {
        return {units(Quantity::speed, result.speeds[i]), value(mode, i)};
    }
    [[nodiscard]] std::vector<PlotPoint> points(const CampbellMode &mode, Stretch over) const {
        std::vector<PlotPoint> line;
        for (std::size_t i = over.from; i <= over.to; ++i)
            line.push_back(point(mode, i));
        return line;
    }
};

std::string known(std::optional<double> value, int digits) {
    return value && std::isfinite(*value) ? readable(*value, digits) : "–";
}

/// All of a mode at a speed, for the page.
std::string all_of(const Units &units, const CampbellResult &result, const CampbellMode &mode,
                   std::size_t i) {
    return fmt::format(
        "{} at {}\nfrequency {}\nreal part {}\ndamping ratio {}, log. decrement {}\n"
        "{} whirl, forward share {}\nerror {}, residual {}",
        mode.label, units.text(Quantity::speed, result.speeds[i], 7),
        units.text(Quantity::frequency, mode.frequency[i].value_or(NAN), 10),
        known(entry(mode.real, i) ? std::optional(units(Quantity::rate, *mode.real[i]))
                                  : std::nullopt,
              5),
        known(entry(mode.damping_ratio, i), 5), known(entry(mode.log_dec, i), 5),
        whirl_text(mode.whirl[i], entry(mode.plane, i), units), known(mode.forward_fraction[i], 4),
        known(entry(mode.error, i), 2), known(entry(mode.residual, i), 2));
}

/// Where motions grow, broad behind the lines; of a band as narrow as one speed a point.
void add_growth(const CampbellView &shown, std::vector<ChartCurve> &curves) {
    for (const CampbellMode &mode : shown.result.modes)
        for (const Stretch &over : stretches(
                 springs(mode, shown.result), [&](std::size_t i) { return shown.value(mode, i); },
                 [&](std::size_t i) { return grows(mode, i); }))
            if (grows(mode, over.from))
                curves.push_back({"unstable",
                                  shown.points(mode, over),
                                  {"", "#EC75B6", "1"},
                                  9,
                                  over.from == over.to ? 1.4 : 0});
}

/// The other frequencies of motions that have two, in the fixed frame.
void add_other_frequencies(const CampbellView &shown, std::vector<ChartCurve> &curves) {
    std::vector<PlotPoint> line;
    for (const CampbellMode &mode : shown.result.modes) {
        const std::vector<double> &speeds = shown.result.speeds;
        const std::vector<bool> changes = other_of_two(mode, speeds);
        const auto add = [&](std::size_t i, std::optional<double> frequency) {
            line.push_back({shown.units(Quantity::speed, speeds[i]), std::nullopt});
            if (frequency)
                line.back().y = shown.units(Quantity::frequency, *frequency);
        };
        for (std::size_t i = 0; i < speeds.size() && !mode.other_frequency.empty(); ++i) {
            const auto value = entry(mode.other_frequency, i);
            add(i, value);
            if (!changes[i])
                continue;
            // There the frequency that was drawn becomes the other one: the lines meet.
            if (value)
                add(i + 1, entry(mode.frequency, i + 1));
            add(i, std::nullopt);
            if (entry(mode.other_frequency, i + 1))
                add(i, entry(mode.frequency, i));
        }
        if (!line.empty())
            line.push_back({line.back().x, std::nullopt});
    }
    if (std::ranges::any_of(line, [](const PlotPoint &point) { return point.y.has_value(); }))
        curves.push_back({"its other frequency", line, {"", "#707070", "(2,3)"}, 1.2});
}

/// A line for each stretch of one sense, to where the next one begins.
/// @param all  the page says all of each point
void add_modes(const CampbellView &shown, bool all, std::vector<ChartCurve> &curves) {
    const CampbellResult &result = shown.result;
    for (const CampbellMode &mode : result.modes) {
        const std::vector<bool> sprung = springs(mode, result);
        for (Stretch over : stretches(
                 sprung, [&](std::size_t i) { return shown.value(mode, i); },
                 [&](std::size_t i) { return mode.whirl[i]; })) {
            const LineStyle style = whirl_style(mode.whirl[over.from]);
            if (over.to + 1 < sprung.size() && !sprung[over.to] && shown.value(mode, over.to + 1))
                ++over.to;
            curves.push_back({style.name, shown.points(mode, over), style});
            ChartCurve &line = curves.back();
            line.marker = 0.8;
            line.every = std::max<std::size_t>(1, result.speeds.size() / 10);
            for (std::size_t i = over.from; i <= over.to; ++i)
                line.texts.push_back(
                    all ? all_of(shown.units, result, mode, i)
                        : fmt::format("{} at {}\n{}", mode.label,
                                      shown.units.text(Quantity::speed, result.speeds[i], 7),
                                      readable(*shown.value(mode, i), 6)));
        }
    }
}

/// Names of the modes at the last speed: "1F"; with the direction in which one moves as a line:
/// "1M, vertical".
std::vector<ChartLabel> mode_names(const CampbellView &shown) {
    std::vector<ChartLabel> names;
    const std::size_t last = shown.result.speeds.size() - 1;
    for (const CampbellMode &mode : shown.result.modes)
        if (const auto value = shown.value(mode, last); value && !mode.whirl.empty()) {
            const std::string plane = plane_text(entry(mode.plane, last), shown.units);
            names.push_back({mode.label + (plane.empty() ? "" : ", " + plane),
                             shown.point(mode, last).x, *value,
                             whirl_style(mode.whirl.back()).colour});
        }
    return names;
}

/// Lines y = multiple * speed with their names.
void add_multiples(const model::Case &scene, const Units &units, ChartPanel &panel) {
    std::vector<double> multiples = scene.campbell.multiples;
    if (std::ranges::find(multiples, 1.0) == multiples.end())
        multiples.push_back(1.0);
    const double synchronous = units.factor(Quantity::frequency) / units.factor(Quantity::speed);
    const double start = std::max(*panel.x.low, 0.0);
    for (const double multiple : multiples) {
        const double slope = multiple * synchronous;
        const double end = std::min(*panel.x.high, *panel.y.high / slope);
        if (end <= *panel.x.low)
            continue;
        panel.curves.push_back(
            {"", {{start, slope * start}, {end, slope * end}}, {"", "#777777", "(9,7)"}, 1.2});
        panel.ends.push_back({drawn_number(multiple) + "×", end, slope * end, "#555555"});
    }
}

/// Circles at the crossings, black where a margin counts, grey where damping is so heavy that none
/// is needed; and from a frequency on, in its unit, their speeds.
void add_crossings(const CampbellResult &result, const Units &units, double named_above,
                   ChartPanel &panel) {
    for (const bool heavy : {true, false}) {
        const std::string colour = heavy ? heavy_colour : "#000000";
        ChartCurve circles{heavy ? "heavily damped" : "crossing", {}, {"", colour, "1", 6}, 0, 1.7};
        for (const Crossing &crossing : result.crossings) {
            const double x = units(Quantity::speed, crossing.speed);
            const double y = units(Quantity::frequency, crossing.frequency);
            if (crossing.damping.heavy() != heavy || y <= 0 || y >= *panel.y.high)
                continue;
            const auto mode = static_cast<std::size_t>(crossing.mode);
            circles.points.push_back({x, y});
            circles.texts.push_back(fmt::format(
                "crossing of {} with {}×\n{}",
                mode < result.modes.size() ? result.modes[mode].label : "",
                readable(crossing.multiple), units.text(Quantity::speed, crossing.speed, 10)));
            if (y >= named_above)
                panel.labels.push_back(
                    {drawn_speed(units, crossing.speed) + " " + units.name(Quantity::speed), x, y,
                     colour});
        }
        if (!circles.points.empty())
            panel.curves.push_back(std::move(circles));
    }
}

/// Ends of the panels of frequencies: all of them, and where what happens at the spin speed is low
/// down, or all crossings are, that part alone.
std::vector<double> tops_of(const CampbellResult &result, const Units &units) {
    const double highest = units(Quantity::frequency, highest_of(result));
    std::vector<double> tops{highest > 0 ? 1.05 * highest : 1};
    double lowest = HUGE_VAL;
    for (const CampbellMode &mode : result.modes)
        for (const auto &frequency : mode.frequency)
            lowest = std::min(lowest, frequency ? units(Quantity::frequency, *frequency) : lowest);
    double reach = result.speeds.empty() ? 0 : units(Quantity::frequency, result.speeds.back());
    double crossed = 0;
    for (const Crossing &crossing : result.crossings)
        crossed = std::max(crossed, units(Quantity::frequency, crossing.frequency));
    if (crossed > 0 && crossed < 0.3 * reach)
        reach = 1.5 * crossed;
    if (reach > 0 && reach < 0.22 * highest && lowest < 1.35 * reach)
        tops.push_back(1.35 * reach);
    return tops;
}

/// Logarithmic decrements of a damped rotor, with the limit of stability.
std::optional<ChartPanel> damping_panel(const CampbellView &shown, const ChartAxis &x) {
    double largest = 0;
    double smallest = 0;
    for (const CampbellMode &mode : shown.result.modes)
        for (const auto &decrement : mode.log_dec) {
            largest = std::max(largest, decrement.value_or(0));
            smallest = std::min(smallest, decrement.value_or(0));
        }
    if (largest <= 1e-9 && smallest >= -1e-9)
        return std::nullopt;
    const double top = 1.08 * std::min(largest, log_dec_limit);
    const double bottom = 1.35 * std::max(smallest, -log_dec_limit);
    ChartPanel panel{270, x, {.title = "Logarithmic decrement"}, {}};
    panel.y.low = std::min(bottom, -0.04 * top);
    panel.y.high = std::max(top, 0.02);
    panel.curves.push_back(level_line(panel, 0, {"", "#555555", "1"}));
    add_growth(shown, panel.curves);
    add_modes(shown, false, panel.curves);
    panel.ends = mode_names(shown);
    return panel;
}

} // namespace

bool grows(const CampbellMode &mode, std::size_t index) {
    const auto real = entry(mode.real, index);
    if (!real || !std::isfinite(*real) || *real <= 0)
        return false;
    const double modulus = std::hypot(*real, entry(mode.frequency, index).value_or(0));
    const double doubt =
        entry(mode.error, index).value_or(0) + entry(mode.residual, index).value_or(0);
    return *real > std::max(1e-9, doubt) * modulus;
}

Chart campbell_chart(const model::Case &scene, const CampbellResult &result, const Units &units) {
    const CampbellView shown{result, units, false};
    const ChartAxis x = along_speeds(units, result.speeds);
    ChartAxis y = chart_axis(units, "Whirl frequency", Quantity::frequency);
    y.low = 0;
    if (!units.asked(Quantity::frequency))
        y.second = {"Whirl frequency (cycles/min)", 30 / pi / units.factor(Quantity::frequency)};
    Chart chart{"Campbell diagram: " + title_of(scene),
                fmt::format("{} form, shaft order {}, {} elements, {} unknowns",
                            results::form_name(result.model.formulation.form), result.model.order,
                            result.model.elements, result.model.unknowns),
                {}};
    const std::vector<double> tops = tops_of(result, units);
    for (const double top : tops) {
        const bool first = chart.panels.empty();
        ChartPanel panel{first ? 500 : 270, x, y, {}};
        panel.y.high = top;
        if (first && !units.asked(Quantity::speed)) // in the units of theory
            panel.x.second = {Units().label("Spin speed", Quantity::speed),
                              1 / units.factor(Quantity::speed)};
        add_growth(shown, panel.curves);
        add_other_frequencies(shown, panel.curves);
        add_modes(shown, first, panel.curves);
        panel.ends = mode_names(shown);
        add_multiples(scene, units, panel);
        // Crossings that the low panel shows larger get their names there.
        add_crossings(result, units, first && tops.size() > 1 ? tops.back() : 0, panel);
        chart.panels.push_back(std::move(panel));
    }
    if (auto damping = damping_panel({result, units, true}, x))
        chart.panels.push_back(std::move(*damping));
    return chart;
}

} // namespace whirl::report
