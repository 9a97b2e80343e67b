#include "report/pictures/campbell_panel.h"

#include "report/common/gnuplot.h"
#include "report/common/words.h"
#include "results/formulation.h"
#include "results/whirl.h"

#include <algorithm>
#include <cmath>

namespace whirl::report {

using results::CampbellMode;
using results::CampbellResult;
using results::Whirl;

std::optional<double> Panel::value(const CampbellMode &mode, std::size_t i) const {
    const auto value = entry(damping ? mode.log_dec : mode.frequency, i);
    return value && !damping ? std::optional(frequency(*value)) : value;
}

std::string end_name(const Units &units, const CampbellMode &mode) {
    const std::optional<double> plane = mode.plane.empty() ? std::nullopt : mode.plane.back();
    return mode.label + (plane ? ", " + plane_text(plane, units) : "");
}

namespace {

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

/// In a Hill series motions that resonate exchange their larger parts. Where a line begins or ends
/// beside that, nothing before or after tells that its step is one to the other motion, but that
/// the other line goes the opposite way.
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

/// sprung_steps() of one mode.
std::vector<bool> springs(const CampbellMode &mode, const CampbellResult &result, double highest) {
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

/// Takes over a line that has ended; one point is none.
void end_line(std::vector<PlotPoint> &line, std::vector<std::vector<PlotPoint>> &lines) {
    if (line.size() > 1)
        lines.push_back(line);
    line.clear();
}

} // namespace

std::vector<std::vector<bool>> sprung_steps(const CampbellResult &result) {
    double highest = 0;
    for (const CampbellMode &mode : result.modes)
        for (const auto &frequency : mode.frequency)
            highest = std::max(highest, frequency.value_or(0));
    std::vector<std::vector<bool>> steps;
    for (const CampbellMode &mode : result.modes)
        steps.push_back(springs(mode, result, highest));
    return steps;
}

std::vector<std::vector<PlotPoint>>
stretches(const Panel &panel, const CampbellResult &result,
          const std::function<bool(const CampbellMode &, std::size_t)> &belongs) {
    std::vector<std::vector<PlotPoint>> lines;
    const std::vector<std::vector<bool>> steps = sprung_steps(result);
    for (std::size_t m = 0; m < result.modes.size(); ++m) {
        const CampbellMode &mode = result.modes[m];
        const std::vector<bool> &sprung = steps[m];
        std::vector<PlotPoint> line;
        for (std::size_t i = 0; i + 1 < result.speeds.size(); ++i) {
            const auto here = panel.value(mode, i);
            const auto next = panel.value(mode, i + 1);
            if (here && next && !sprung[i] && belongs(mode, i)) {
                if (line.empty())
                    line.push_back({panel.speed(result.speeds[i]), here});
                line.push_back({panel.speed(result.speeds[i + 1]), next});
            } else {
                end_line(line, lines);
            }
        }
        end_line(line, lines);
    }
    return lines;
}

std::vector<std::vector<PlotPoint>> other_frequencies(const Panel &panel,
                                                      const CampbellResult &result) {
    std::vector<std::vector<PlotPoint>> lines;
    for (const CampbellMode &mode : result.modes) {
        if (panel.damping || mode.other_frequency.empty())
            continue;
        const std::vector<bool> changes = other_of_two(mode, result.speeds);
        std::vector<PlotPoint> line;
        for (std::size_t i = 0; i < result.speeds.size(); ++i) {
            const auto value = entry(mode.other_frequency, i);
            if (!value)
                end_line(line, lines);
            else
                line.push_back({panel.speed(result.speeds[i]), panel.frequency(*value)});
            if (!changes[i])
                continue;
            // There the frequency that was drawn becomes the other one: the lines meet.
            if (const auto next = entry(mode.frequency, i + 1); value && next)
                line.push_back({panel.speed(result.speeds[i + 1]), panel.frequency(*next)});
            end_line(line, lines);
            if (const auto here = entry(mode.frequency, i);
                here && entry(mode.other_frequency, i + 1))
                line.push_back({panel.speed(result.speeds[i]), panel.frequency(*here)});
        }
        end_line(line, lines);
    }
    return lines;
}

std::vector<PlotPoint> markers(const Panel &panel, const CampbellResult &result, Whirl sense) {
    std::vector<PlotPoint> points;
    const std::vector<std::vector<bool>> steps = sprung_steps(result);
    const std::size_t step = std::max<std::size_t>(1, result.speeds.size() / 10);
    for (std::size_t m = 0; m < result.modes.size(); ++m) {
        const CampbellMode &mode = result.modes[m];
        const std::vector<bool> &sprung = steps[m];
        for (std::size_t i = 0; i < result.speeds.size() && i < mode.whirl.size(); ++i) {
            const auto value = panel.value(mode, i);
            const bool lone =
                (i == 0 || sprung[i - 1] || !panel.value(mode, i - 1)) &&
                (i + 1 >= result.speeds.size() || sprung[i] || !panel.value(mode, i + 1));
            if (value && mode.whirl[i] == sense && (lone || (i + m * step / 3) % step == step / 2))
                points.push_back({panel.speed(result.speeds[i]), value});
        }
    }
    return points;
}

} // namespace whirl::report
