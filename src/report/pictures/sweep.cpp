#include "report/pictures/figures.h"

#include "report/answers.h"
#include "report/pictures/operation.h"
#include "report/pictures/style.h"
#include "results/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

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
};

/// The entry under an axis: what it is, and how much.
std::string under_axis(const Units &units, const SweepAxis &axis) {
    const std::string entry = axis.entries.empty() ? "" : axis.entries.front().path;
    const std::string more =
        axis.entries.size() > 1 ? fmt::format(" and {} more", axis.entries.size() - 1) : "";
    const char *change = axis.change == model::SweepChange::factor  ? "factor of "
                         : axis.change == model::SweepChange::shift ? "shift of "
                                                                    : "";
    return change + entry + more +
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

/// One entry: answers of a kind together. Two: a panel an answer.
std::vector<SweepPanel> panels_of(const SweepResult &result, const Units &units) {
    std::vector<SweepPanel> panels;
    std::string kind;
    for (const SampledAnswer &answer : result.answers) {
        if (answer.present == 0)
            continue;
        if (result.axes.size() > 1) {
            SweepPanel panel{answer_text(answer, units), answer.quantity, {}};
            panel.what += ": " + over_axis(units, panel, answer.of);
            const SweepAxis &y = result.axes.back();
            for (std::size_t row = 0; row < y.values.size(); ++row)
                panel.curves.push_back({units.text(y.quantity, y.values[row], 4),
                                        curve_of(result, answer, row, units)});
            panels.push_back(std::move(panel));
            continue;
        }
        const std::string own = answer.of + names_of(answer.quantity).name;
        if (own != kind) {
            SweepPanel panel{"", answer.quantity, {}};
            panel.what = over_axis(units, panel, answer.of);
            panels.push_back(std::move(panel));
        }
        kind = own;
        panels.back().curves.push_back(
            {answer_text(answer, units), curve_of(result, answer, 0, units)});
    }
    return panels;
}

/// Of many curves some, evenly spread, with the first and the last.
std::vector<NamedCurve> some_of(const std::vector<NamedCurve> &curves) {
    if (curves.size() <= most_sweep_curves)
        return curves;
    std::vector<NamedCurve> out;
    for (std::size_t i = 0; i < most_sweep_curves; ++i)
        out.push_back(curves[i * (curves.size() - 1) / (most_sweep_curves - 1)]);
    return out;
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
    for (SweepPanel &panel : panels) {
        left_out = left_out || panel.curves.size() > most_sweep_curves;
        panel.curves = some_of(panel.curves);
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
