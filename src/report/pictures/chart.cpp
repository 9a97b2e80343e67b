#include "report/pictures/chart.h"

#include "report/common/json.h"
#include "report/common/text_width.h"
#include "report/pictures/labels.h"
#include "report/pictures/operation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace whirl::report {

namespace {

// Pixels: below the heading of the figure, above a panel with a title, and below a panel with and
// without a name of its axis.
constexpr int chart_head = 75, chart_above_title = 22, chart_below_name = 66,
              chart_below_numbers = 32;

Range needed_by(const std::vector<ChartCurve> &curves, bool along_x) {
    std::vector<double> values;
    for (const ChartCurve &curve : curves)
        for (const PlotPoint &point : curve.points)
            if (point.y && std::isfinite(*point.y))
                values.push_back(along_x ? point.x : *point.y);
    return range_of(values);
}

/// gnuplot draws nothing on an axis of which neither end is known.
bool draws_nothing(const ChartPanel &panel) {
    return std::ranges::none_of(panel.curves, [](const ChartCurve &curve) {
        return std::ranges::any_of(curve.points, [](const PlotPoint &point) {
            return point.y && std::isfinite(*point.y);
        });
    });
}

/// Numbers 1, 2, 5 of every power of ten on a logarithmic axis that has few of these; else
/// gnuplot's own.
std::string ticks_of(const ChartAxis &axis, char name) {
    constexpr double few = 100;
    if (axis.step > 0)
        return fmt::format("{:.9g}", axis.step);
    if (name != 'x' || !axis.logarithmic || !axis.low || !axis.high || !(*axis.low > 0) ||
        *axis.high > few * *axis.low)
        return "autofreq";
    std::string ticks;
    for (double power = std::pow(10, std::floor(std::log10(*axis.low))); power <= *axis.high;
         power *= 10)
        for (const double digit : {1, 2, 5})
            if (const double at = digit * power; at >= *axis.low && at <= *axis.high)
                ticks += fmt::format("{}{:.9g}", ticks.empty() ? "" : ", ", at);
    return ticks.empty() ? "autofreq" : "(" + ticks + ")";
}

std::string axis_commands(const ChartAxis &axis, char name, bool empty) {
    const auto end = [empty](const std::optional<double> &at, double otherwise) {
        return at      ? fmt::format("{}", *at) // in full: a curve may end there
               : empty ? fmt::format("{}", otherwise)
                       : std::string("*");
    };
    return fmt::format("{0} logscale {1}\nset format {1} '{2}'\nset {1}range [{3}:{4}]\n"
                       "set {1}tics {5}\n",
                       axis.logarithmic ? "set" : "unset", name,
                       axis.logarithmic && (name == 'y' || axis.high.value_or(0) > 1e4) ? "10^{%L}"
                                                                                        : "%g",
                       end(axis.low, axis.logarithmic ? 1 : 0),
                       end(axis.high, axis.logarithmic ? 10 : 1), ticks_of(axis, name)) +
           (axis.title.empty() ? fmt::format("unset {}label\n", name)
                               : fmt::format("set {}label {}\n", name, plot_text(axis.title)));
}

std::string chart_look(const ChartCurve &curve) {
    const LineStyle &style = curve.style;
    std::string look =
        fmt::format("with {}{} lc rgb '{}'", curve.width > 0 ? "lines" : "",
                    curve.marker > 0 || curve.width <= 0 ? "points" : "", style.colour);
    if (curve.width > 0)
        look += fmt::format(" lw {} dt {}", curve.width, style.dash);
    if (curve.marker > 0)
        look += fmt::format(" pt {} ps {}", style.point, curve.marker);
    if (curve.marker > 0 && curve.width > 0 && curve.every > 1)
        look += fmt::format(" pointinterval {}", curve.every);
    return look;
}

Json chart_axis_json(const ChartAxis &axis) {
    return {{"title", axis.title}, {"unit", axis.unit}, {"spin_speed", axis.spin_speed},
            {"low", axis.low},     {"high", axis.high}, {"logarithmic", axis.logarithmic},
            {"step", axis.step}};
}

/// Where values lie in a panel, in parts of it.
struct Across {
    Range x, y;
    bool logarithmic;
    [[nodiscard]] double along(double value) const { return (value - x.low) / (x.high - x.low); }
    [[nodiscard]] double up(double value) const {
        return logarithmic ? std::log(value / y.low) / std::log(y.high / y.low)
                           : (value - y.low) / (y.high - y.low);
    }
};

/// Labels beside their points, off the curves, with a line where they stand far from them; those
/// without room are counted.
std::string labels_of(const ChartPanel &panel, const Across &at, double pixels_wide) {
    constexpr double size = 10;  // of the letters, pixels
    constexpr double around = 6; // of a point of a curve, pixels
    constexpr double far = 18;   // from a point another's label could stand, pixels
    const double high = panel.height;
    LabelPlacer placer;
    for (const ChartCurve &curve : panel.curves)
        for (const PlotPoint &point : curve.points)
            if (point.y && !curve.on_page && curve.width > 0 && (*point.y > 0 || !at.logarithmic))
                placer.block({at.along(point.x) - around / 2 / pixels_wide,
                              at.up(*point.y) - around / 2 / high, around / pixels_wide,
                              around / high});
    std::string script;
    int unnamed = 0;
    for (const ChartLabel &label : panel.labels) {
        const double x = at.along(label.x);
        const double y = at.up(label.y);
        const auto box =
            placer.place(x, y, (text_width(label.text, size) + 8) / pixels_wide, 15 / high);
        unnamed += box ? 0 : 1;
        if (!box)
            continue;
        script += fmt::format("set label {} at graph {},{} left font ',{}'\n",
                              plot_text(label.text), box->x, box->y + box->height / 2, size);
        const double to_x = std::clamp(x, box->x, box->x + box->width);
        const double to_y = std::clamp(y, box->y, box->y + box->height);
        if (std::hypot((to_x - x) * pixels_wide, (to_y - y) * high) >= far)
            script += fmt::format("set arrow from graph {},{} to graph {},{} nohead lw 0.6 lc rgb "
                                  "'#999999'\n",
                                  x, y, to_x, to_y);
    }
    return script + left_out(unnamed, "peak", "0.01,0.04");
}

} // namespace

ChartAxis chart_axis(const Units &units, const std::string &what, Quantity quantity) {
    return {.title = units.label(what, quantity),
            .unit = units.name(quantity),
            .spin_speed = quantity == Quantity::speed};
}

ChartCurve chart_curve(const std::string &name, std::vector<PlotPoint> points, std::size_t index,
                       double width, const std::string &dash) {
    ChartCurve curve{name, std::move(points), series_style(index), width, 0};
    if (!dash.empty())
        curve.style.dash = dash;
    return curve;
}

void span_decades(ChartAxis &axis, const std::vector<ChartCurve> &curves, double share,
                  double share_of_smallest) {
    double least = HUGE_VAL;
    double largest = 0;
    double smallest = HUGE_VAL; // of the largest values
    for (const ChartCurve &curve : curves) {
        double most = 0;
        for (const PlotPoint &point : curve.points)
            if (point.y && *point.y > 0 && std::isfinite(*point.y)) {
                least = std::min(least, *point.y);
                most = std::max(most, *point.y);
            }
        largest = std::max(largest, most);
        if (most > 0)
            smallest = std::min(smallest, most);
    }
    axis.logarithmic = largest > 0;
    axis.low = 0;
    axis.high = 1;
    if (!axis.logarithmic)
        return;
    const double low = std::max({least, share * largest, share_of_smallest * smallest});
    const double power = std::pow(10, std::floor(std::log10(largest)) + 1);
    axis.low = std::pow(10, std::floor(std::log10(low)));
    axis.high = largest > 0.5 * power ? 2 * power : power; // room for what stands above a peak
}

Figure chart_figure(const Chart &chart, const model::Case &scene, const Units &units) {
    std::vector<std::string> names{"operating speeds"};
    int height = chart_head;
    for (const ChartPanel &panel : chart.panels) {
        height += (panel.title.empty() ? 0 : chart_above_title) + panel.height +
                  (panel.x.title.empty() ? chart_below_numbers : chart_below_name);
        for (const ChartCurve &curve : panel.curves)
            if (!curve.on_page)
                names.push_back(curve.name);
    }
    const LegendedFigure room = beside_legend(864, 1080, height, names);
    std::string script = grid;
    std::set<std::string> keyed{""}; // names in the legend, each once
    int top = chart_head;
    for (const ChartPanel &panel : chart.panels) {
        top += panel.title.empty() ? 0 : chart_above_title;
        Curves drawn;
        for (const ChartCurve &curve : panel.curves)
            if (!curve.on_page)
                drawn.add(curve.points, chart_look(curve),
                          keyed.insert(curve.name).second ? plot_text(curve.name) : "");
        const auto range = [&](const ChartAxis &axis, bool along_x) {
            const Range all = needed_by(panel.curves, along_x);
            return Range{axis.low.value_or(all.low), axis.high.value_or(all.high)};
        };
        const Across at{range(panel.x, true), range(panel.y, false), panel.y.logarithmic};
        script +=
            room.panel(top, top + panel.height) +
            axis_commands(panel.x, 'x', draws_nothing(panel)) +
            axis_commands(panel.y, 'y', draws_nothing(panel)) + legend_beside +
            (panel.title.empty() ? "unset title\n"
                                 : "set title " + plot_text(panel.title) + " offset 0,-0.6\n");
        for (const bool along_x : {true, false})
            if ((along_x ? panel.x : panel.y).spin_speed) {
                const Range &speeds = along_x ? at.x : at.y;
                script +=
                    operation_band(scene, units, speeds, along_x ? SpeedAxis::x : SpeedAxis::y);
                if (keyed.insert("operating speeds").second)
                    drawn.add(operation_key(scene, units, speeds));
            }
        script += labels_of(panel, at, (room.right - room.left) * room.width) + drawn.script() +
                  "unset object\nunset arrow\nunset label\n";
        top += panel.height + (panel.x.title.empty() ? chart_below_numbers : chart_below_name);
    }
    if (chart.panels.empty())
        script += "set xrange [0:1]\nset yrange [0:1]\nset label 'nothing to draw' at graph "
                  "0.5,0.5 center\nplot NaN notitle\n";
    return figure_of(room.width, height, chart.title, chart.subtitle, script);
}

Json chart_json(const Chart &chart) {
    Json panels = Json::array();
    for (const ChartPanel &panel : chart.panels) {
        Json curves = Json::array();
        for (const ChartCurve &curve : panel.curves)
            curves.push_back({{"name", curve.name},
                              {"points", curve.points},
                              {"colour", curve.style.colour},
                              {"dash", curve.style.dash},
                              {"point", curve.style.point},
                              {"width", curve.width},
                              {"marker", curve.marker},
                              {"every", curve.every},
                              {"texts", curve.texts}});
        Json labels = Json::array();
        for (const ChartLabel &label : panel.labels)
            labels.push_back({{"text", label.text}, {"x", label.x}, {"y", label.y}});
        panels.push_back({{"title", panel.title},
                          {"height", panel.height},
                          {"x", chart_axis_json(panel.x)},
                          {"y", chart_axis_json(panel.y)},
                          {"curves", curves},
                          {"labels", labels}});
    }
    return {{"panels", panels}};
}

} // namespace whirl::report
