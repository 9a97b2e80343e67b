#include "report/pictures/figures.h"

#include "report/answers.h"
#include "report/common/words.h"
#include "report/pictures/style.h"
#include "results/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

namespace whirl::report {

using model::SweepAxis;
using results::SampledAnswer;
using results::SweepResult;

namespace {

constexpr std::size_t most_sweep_panels = 6;
constexpr std::size_t most_sweep_curves = 10; // a panel

/// Curves over the first axis that share a panel.
struct SweepPanel {
    ChartAxis y{};
    std::vector<ChartCurve> curves{};
    bool left_out = false; ///< there are more curves than are drawn
};

/// The entry under an axis: what it is, and how much.
std::string under_axis(const Units &units, const SweepAxis &axis) {
    return axis_name(axis) +
           (axis.quantity == Quantity::number ? "" : " (" + units.name(axis.quantity) + ")");
}

std::vector<PlotPoint> curve_of(const SweepResult &result, const SampledAnswer &answer,
                                std::size_t row, const Units &units) {
    const SweepAxis &x = result.axes.front();
    std::vector<PlotPoint> points;
    for (std::size_t i = 0; i < x.values.size(); ++i) {
        PlotPoint point{units(x.quantity, x.values[i]), std::nullopt};
        if (const auto value = answer.values[row * x.values.size() + i])
            point.y = units(answer.quantity, *value);
        points.push_back(point);
    }
    return points;
}

/// Two entries: a panel an answer, a curve for each value of the second one.
SweepPanel panel_of_one(const SweepResult &result, const SampledAnswer &answer,
                        const Units &units) {
    SweepPanel panel{answer_axis(units, answer)};
    panel.y.title = answer_text(answer, units) + ": " + panel.y.title;
    const SweepAxis &y = result.axes.back();
    panel.left_out = y.values.size() > most_sweep_curves;
    for (const std::size_t row : spread_over(y.values.size(), most_sweep_curves))
        panel.curves.push_back(chart_curve(units.text(y.quantity, y.values[row], 4),
                                           curve_of(result, answer, row, units),
                                           panel.curves.size()));
    return panel;
}

/// One entry: answers of a kind together; of many those that most rotors have.
SweepPanel panel_of_kind(const SweepResult &result, std::vector<const SampledAnswer *> answers,
                         const Units &units) {
    SweepPanel panel{answer_axis(units, *answers.front())};
    if (answers.size() > most_sweep_curves) {
        std::ranges::stable_sort(answers, std::ranges::greater{}, &SampledAnswer::present);
        answers.resize(most_sweep_curves);
        std::ranges::sort(answers); // in the order of the result again
        panel.left_out = true;
    }
    for (const SampledAnswer *answer : answers)
        panel.curves.push_back(chart_curve(
            answer_text(*answer, units), curve_of(result, *answer, 0, units), panel.curves.size()));
    return panel;
}

std::vector<SweepPanel> panels_of(const SweepResult &result, const Units &units) {
    std::vector<std::vector<const SampledAnswer *>> kinds;
    const bool each = result.axes.size() > 1;
    for (const SampledAnswer &answer : result.answers) {
        if (answer.present == 0)
            continue;
        const auto same = std::ranges::find_if(kinds, [&](const auto &kind) {
            return !each && kind.front()->of == answer.of &&
                   kind.front()->quantity == answer.quantity;
        });
        if (same == kinds.end())
            kinds.push_back({&answer});
        else
            same->push_back(&answer);
    }
    std::vector<SweepPanel> panels;
    for (const auto &kind : kinds)
        panels.push_back(each ? panel_of_one(result, *kind.front(), units)
                              : panel_of_kind(result, kind, units));
    return panels;
}

Range heights_of(const std::vector<ChartCurve> &curves) {
    std::vector<double> values;
    for (const ChartCurve &curve : curves)
        for (const PlotPoint &point : curve.points)
            if (point.y)
                values.push_back(*point.y);
    const Range range = range_of(values);
    const double margin = 0.06 * (range.high - range.low);
    return {range.low >= 0 && range.low < margin ? 0 : range.low - margin, range.high + margin};
}

} // namespace

ChartAxis answer_axis(const Units &units, const SampledAnswer &answer) {
    const Quantity quantity = answer.quantity;
    const char *what = quantity == Quantity::speed       ? "Spin speed"
                       : quantity == Quantity::amplitude ? "Amplitude"
                       : quantity == Quantity::force     ? "Force"
                       : answer.of == "damping"          ? "Logarithmic decrement"
                       : answer.of == "margins"          ? "Separation margin (%)"
                                                         : "Share";
    ChartAxis axis = chart_axis(units, what, quantity);
    if (quantity == Quantity::number)
        axis.title = what;
    return axis;
}

Chart sweep_chart(const model::Case &scene, const SweepResult &result, const Units &units) {
    std::vector<SweepPanel> panels = panels_of(result, units);
    const std::size_t all = panels.size();
    panels.resize(std::min(all, most_sweep_panels));
    bool left_out = all > panels.size();
    const SweepAxis &x = result.axes.front();
    std::vector<double> across;
    for (const double value : x.values)
        across.push_back(units(x.quantity, value));
    const Range ends = range_of(across);
    Chart chart{"Sweep: " + title_of(scene), "", {}};
    for (const SweepPanel &panel : panels) {
        left_out = left_out || panel.left_out;
        const Range y = heights_of(panel.curves);
        ChartPanel &drawn = chart.panels.emplace_back();
        drawn.height = 230;
        drawn.x = {under_axis(units, x), units.name(x.quantity), false, ends.low, ends.high,
                   x.logarithmic};
        drawn.y = panel.y;
        drawn.y.low = y.low;
        drawn.y.high = y.high;
        drawn.curves = panel.curves;
        for (ChartCurve &curve : drawn.curves)
            curve.marker = 0.7;
    }
    std::string subtitle = fmt::format("{} rotors", result.count);
    if (result.axes.size() > 1)
        subtitle += "; curves: " + under_axis(units, result.axes.back());
    if (result.failed > 0)
        subtitle += fmt::format("; {} without an answer", result.failed);
    if (scene.operation)
        subtitle += "; green: operating speeds";
    if (left_out)
        subtitle += "; not all is drawn: sweep.csv has it";
    chart.subtitle = subtitle;
    return chart;
}

} // namespace whirl::report
