#include "report/pictures/figures.h"

#include "report/answers.h"
#include "report/common/words.h"
#include "report/pictures/operation.h"
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
    std::string what;
    Quantity quantity = Quantity::number;
    std::vector<NamedCurve> curves;
    bool left_out = false; ///< there are more curves than are drawn
};

/// The entry under an axis: what it is, and how much.
std::string under_axis(const Units &units, const SweepAxis &axis) {
    return axis_name(axis) +
           (axis.quantity == Quantity::number ? "" : " (" + units.name(axis.quantity) + ")");
}

std::string over_axis(const Units &units, const SweepPanel &panel, const std::string &of) {
    const char *what = panel.quantity == Quantity::speed       ? "Spin speed"
                       : panel.quantity == Quantity::amplitude ? "Amplitude"
                       : panel.quantity == Quantity::force     ? "Force"
                       : of == "damping"                       ? "Logarithmic decrement"
                       : of == "margins"                       ? "Separation margin (%)"
                                                               : "Share";
    return panel.quantity == Quantity::number ? what : units.label(what, panel.quantity);
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
    SweepPanel panel{"", answer.quantity, {}};
    panel.what = answer_text(answer, units) + ": " + over_axis(units, panel, answer.of);
    const SweepAxis &y = result.axes.back();
    panel.left_out = y.values.size() > most_sweep_curves;
    for (const std::size_t row : spread_over(y.values.size(), most_sweep_curves))
        panel.curves.push_back(
            {units.text(y.quantity, y.values[row], 4), curve_of(result, answer, row, units)});
    return panel;
}

/// One entry: answers of a kind together; of many those that most rotors have.
SweepPanel panel_of_kind(const SweepResult &result, std::vector<const SampledAnswer *> answers,
                         const Units &units) {
    SweepPanel panel{"", answers.front()->quantity, {}};
    panel.what = over_axis(units, panel, answers.front()->of);
    if (answers.size() > most_sweep_curves) {
        std::ranges::stable_sort(answers, std::ranges::greater{}, &SampledAnswer::present);
        answers.resize(most_sweep_curves);
        std::ranges::sort(answers); // in the order of the result again
        panel.left_out = true;
    }
    for (const SampledAnswer *answer : answers)
        panel.curves.push_back({answer_text(*answer, units), curve_of(result, *answer, 0, units)});
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

Range heights_of(const std::vector<NamedCurve> &curves) {
    std::vector<double> values;
    for (const NamedCurve &curve : curves)
        for (const PlotPoint &point : curve.points)
            if (point.y)
                values.push_back(*point.y);
    const Range range = range_of(values);
    const double margin = 0.06 * (range.high - range.low);
    return {range.low >= 0 && range.low < margin ? 0 : range.low - margin, range.high + margin};
}

} // namespace

Figure sweep_figure(const model::Case &scene, const SweepResult &result, const Units &units) {
    std::vector<SweepPanel> panels = panels_of(result, units);
    const std::size_t all = panels.size();
    panels.resize(std::min(all, most_sweep_panels));
    std::vector<std::string> names;
    bool left_out = all > panels.size();
    for (const SweepPanel &panel : panels) {
        left_out = left_out || panel.left_out;
        for (const NamedCurve &curve : panel.curves)
            names.push_back(curve.name);
    }
    constexpr int head = 80;
    constexpr int height = 300; // of a panel
    constexpr int below = 70;
    const int count = std::max(static_cast<int>(panels.size()), 1);
    const LegendedFigure figure = beside_legend(860, 1000, head + count * height, names);
    const SweepAxis &x = result.axes.front();
    std::vector<double> across;
    for (const double value : x.values)
        across.push_back(units(x.quantity, value));
    std::string text = std::string(grid) + legend_beside;
    for (std::size_t i = 0; i < panels.size(); ++i) {
        const SweepPanel &panel = panels[i];
        const Range y = heights_of(panel.curves);
        Curves drawn;
        for (std::size_t k = 0; k < panel.curves.size(); ++k) {
            const LineStyle style = series_style(k);
            drawn.add(panel.curves[k].points,
                      fmt::format("with linespoints lc rgb '{}' lw 1.8 dt {} pt {} ps 0.7",
                                  style.colour, style.dash, style.point),
                      plot_text(panel.curves[k].name));
        }
        const int top = head + static_cast<int>(i) * height;
        text += figure.panel(top, top + height - below) + axes_over(range_of(across), y) +
                (x.logarithmic ? "set logscale x\n" : "") +
                (panel.quantity == Quantity::speed ? operation_band(scene, units, y, SpeedAxis::y)
                                                   : "") +
                fmt::format("set ylabel {}\nset xlabel {}\n", plot_text(panel.what),
                            plot_text(under_axis(units, x))) +
                drawn.script() + "unset object\nunset arrow\nunset label\nunset logscale\n";
    }
    if (panels.empty())
        text += figure.panel(head, head + height - below) +
                "set xrange [0:1]\nset yrange [0:1]\nset label 'no answers' at graph 0.5,0.5 "
                "center\nplot NaN notitle\n";
    std::string subtitle = fmt::format("{} rotors", result.count);
    if (result.axes.size() > 1)
        subtitle += "; curves: " + under_axis(units, result.axes.back());
    if (result.failed > 0)
        subtitle += fmt::format("; {} without an answer", result.failed);
    if (scene.operation)
        subtitle += "; green: operating speeds";
    if (left_out)
        subtitle += "; not all is drawn: sweep.csv has it";
    return figure_of(figure.width, figure.height, "Sweep: " + title_of(scene), subtitle, text);
}

} // namespace whirl::report
