#include "report/pictures/chart.h"

#include "report/common/json.h"
#include "report/common/text_width.h"
#include "report/common/words.h"
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

/// With which numbers at an axis from one value to another differ.
int digits_between(const Range &range) {
    constexpr double most = 15; // the axis has no length
    const double largest = std::max(std::abs(range.low), std::abs(range.high));
    const double length = range.high - range.low;
    const double digits = length > 0 ? 2 + std::ceil(std::log10(largest / length)) : most;
    return static_cast<int>(std::min(digits, most));
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

/// `set xtics` with names at places: percent signs are formats of numbers there, so they are
/// doubled, and the word that ends a plot_text holds for all together.
std::string named_ticks(const ChartAxis &axis) {
    return "(" +
           joined(axis.names, ", ",
                  [](const auto &name) {
                      std::string doubled;
                      for (const char letter : name.second)
                          doubled += letter == '%' ? std::string("%%") : std::string(1, letter);
                      const std::string text = plot_text(doubled);
                      return fmt::format("{} {:.9g}", text.substr(0, text.rfind(' ')), name.first);
                  }) +
           ") noenhanced";
}

std::string second_axis(const ChartAxis &axis, char name) {
    if (!axis.second)
        return fmt::format("set {0}tics mirror\nunset {0}2tics\nunset {0}2label\n", name);
    return fmt::format("set {0}tics nomirror\nset {0}2range [{1}:{2}]\nset {0}2tics\n"
                       "set {0}2label {3}{4}\n",
                       name, *axis.low * axis.second->factor, *axis.high * axis.second->factor,
                       plot_text(axis.second->title), name == 'x' ? " offset 0,-0.4" : "");
}

std::string axis_commands(const ChartAxis &axis, const Range &range, char name, bool empty) {
    constexpr int usual = 6; // digits
    const int digits = digits_between(range);
    const auto end = [empty](const std::optional<double> &at, double otherwise) {
        return at      ? fmt::format("{}", *at) // in full: a curve may end there
               : empty ? fmt::format("{}", otherwise)
                       : std::string("*");
    };
    return fmt::format(
               "{0} logscale {1}\nset format {1} '{2}'\nset {1}range [{3}:{4}]\n"
               "set {1}tics {5}\n",
               axis.logarithmic ? "set" : "unset", name,
               axis.logarithmic && (name == 'y' || axis.high.value_or(0) > 1e4) ? "10^{%L}"
               : !axis.logarithmic && digits > usual ? fmt::format("%.{}g", digits)
                                                     : "%h",
               end(axis.low, axis.logarithmic ? 1 : 0), end(axis.high, axis.logarithmic ? 10 : 1),
               axis.names.empty() ? "enhanced " + ticks_of(axis, name) : named_ticks(axis)) +
           second_axis(axis, name) +
           (axis.title.empty() ? fmt::format("unset {}label\n", name)
                               : fmt::format("set {}label {}\n", name, plot_text(axis.title)));
}

std::string chart_look(const ChartCurve &curve) {
    const LineStyle &style = curve.style;
    if (curve.filled)
        return fmt::format("with filledcurves closed fs solid 1 border lc rgb '{0}' fc rgb '{0}'",
                           style.colour);
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

/// A panel with the ends of its axes, and where it lies in the figure.
struct LaidOut {
    const ChartPanel &panel;
    Range x, y;
    double left, right; ///< pixels
    int top;
    std::string title; ///< as far as there is room for it beside others
    [[nodiscard]] double wide() const { return right - left; }
    [[nodiscard]] double high() const { return panel.height; }
    [[nodiscard]] double along(double value) const { return part(value, x, panel.x.logarithmic); }
    [[nodiscard]] double up(double value) const { return part(value, y, panel.y.logarithmic); }

  private:
    static double part(double value, const Range &of, bool logarithmic) {
        return logarithmic ? std::log(value / of.low) / std::log(of.high / of.low)
                           : (value - of.low) / (of.high - of.low);
    }
};

/// The row of a panel: its first panel, and how many there are.
struct Row {
    std::size_t first, count;
};
Row row_of(const Chart &chart, std::size_t i) {
    const std::vector<ChartPanel> &panels = chart.panels;
    std::size_t first = i, end = i + 1;
    while (first > 0 && panels[first].beside)
        --first;
    while (end < panels.size() && panels[end].beside)
        ++end;
    return {first, end - first};
}

/// Pixels between panels of a row, for what stands left of those on the right.
double between_panels(const Chart &chart) {
    double between = 60;
    for (const ChartPanel &panel : chart.panels)
        if (panel.beside) {
            between = std::max(between, panel.y.title.empty() ? 0.0 : 100.0);
            for (const auto &[at, name] : panel.y.names)
                between = std::max(between, text_width(name, picture_font) + 20);
        }
    return between;
}

/// Of the widest row, pixels: more where panels share one.
double panels_wide(const Chart &chart) {
    const double shared = std::ranges::any_of(chart.panels, &ChartPanel::beside) ? 900 : 752;
    const double between = between_panels(chart);
    double wide = 0;
    for (std::size_t i = 0; i < chart.panels.size(); ++i)
        wide = std::max(wide, chart.panels[i].square ? double(row_of(chart, i).count) *
                                                               (chart.panels[i].height + between) -
                                                           between
                                                     : shared);
    return wide;
}

constexpr int legended_left = 112; // where panels begin: room for a name beside eight characters

// Of letters, pixels.
constexpr double title_size = 15, subtitle_size = 11, panel_title_size = 12;
constexpr double end_size = 11; // of the letters of names at the ends of curves, pixels
constexpr double end_gap = 16;  // from the curves to these, pixels

/// With the axes x so long that the names at the ends of curves have room. Above a row with the
/// same axis x it has no name.
Chart prepared(Chart chart) {
    std::vector<ChartPanel> &panels = chart.panels;
    for (std::size_t i = 0; i < panels.size(); ++i) {
        const Row row = row_of(chart, i);
        const std::size_t below = row.first + row.count;
        if (below < panels.size() && panels[below].x.title == panels[i].x.title &&
            row_of(chart, below).count == row.count)
            panels[i].x.title.clear();
    }
    double widest = 0;
    for (const ChartPanel &panel : chart.panels)
        for (const ChartLabel &end : panel.ends)
            widest = std::max(widest, text_width(end.text, end_size));
    const double strip = end_gap + widest + 8;
    const double share = strip / (panels_wide(chart) - strip);
    for (ChartPanel &panel : chart.panels) {
        if (panel.ends.empty())
            continue;
        const Range all = needed_by(panel.curves, true);
        const double low = panel.x.low.value_or(all.low);
        const double high = panel.x.high.value_or(all.high);
        panel.x.low = low;
        panel.x.high =
            panel.x.logarithmic ? high * std::pow(high / low, share) : high + share * (high - low);
    }
    return chart;
}

/// Panels from above; one beside another shares its row.
/// @param left  where they begin, pixels
std::vector<LaidOut> laid_out(const Chart &chart, double left) {
    constexpr int second_title = 44;
    std::vector<LaidOut> out;
    int top = chart_head;
    if (!chart.panels.empty() && chart.panels.front().x.second)
        top += second_title;
    for (std::size_t i = 0; i < chart.panels.size(); ++i) {
        const ChartPanel &panel = chart.panels[i];
        const double gap = between_panels(chart);
        const auto [first, count] = row_of(chart, i);
        const double wide =
            panel.square ? panel.height : (panels_wide(chart) + gap) / double(count) - gap;
        const double from = left + double(i - first) * (wide + gap);
        const auto range = [&panel](const ChartAxis &axis, bool along_x) {
            const Range all = needed_by(panel.curves, along_x);
            return Range{axis.low.value_or(all.low), axis.high.value_or(all.high)};
        };
        if (panel.beside) // in the row of the one before
            top = out.back().top;
        else
            top += panel.title.empty() ? 0 : chart_above_title;
        out.push_back(
            {panel, range(panel.x, true), range(panel.y, false), from, from + wide, top,
             count == 1 ? panel.title : fitting(panel.title, panel_title_size, wide + gap - 8)});
        top += panel.height + (panel.x.title.empty() ? chart_below_numbers : chart_below_name);
    }
    return out;
}

/// Keeps labels off the curves, their points and the names at their ends.
LabelPlacer occupied(const LaidOut &at) {
    constexpr double around = 6; // of a curve, pixels
    constexpr double most = 200; // places of a straight piece
    LabelPlacer placer;
    const auto block = [&](double x, double y, double pixels) {
        const double width = pixels / at.wide();
        const double height = pixels / at.high();
        if (x >= 0 && x <= 1 && y >= 0 && y <= 1)
            placer.block({x - width / 2, y - height / 2, width, height});
    };
    for (const ChartCurve &curve : at.panel.curves) {
        if (curve.filled) { // all of what it goes around
            const Range x = needed_by({curve}, true);
            const Range y = needed_by({curve}, false);
            placer.block({at.along(x.low), at.up(y.low), at.along(x.high) - at.along(x.low),
                          at.up(y.high) - at.up(y.low)});
            continue;
        }
        std::optional<std::pair<double, double>> before;
        for (const PlotPoint &point : curve.points) {
            if (curve.on_page || !point.y || !std::isfinite(at.up(*point.y))) {
                before.reset();
                continue;
            }
            const std::pair here{at.along(point.x), at.up(*point.y)};
            const auto [x, y] = before && curve.width > 0 ? *before : here;
            const double pixels =
                std::hypot((here.first - x) * at.wide(), (here.second - y) * at.high());
            const int steps = static_cast<int>(std::clamp(std::ceil(pixels / around), 1., most));
            for (int k = 1; k <= steps; ++k)
                block(x + (here.first - x) * k / steps, y + (here.second - y) * k / steps,
                      k == steps ? std::max(around, 8 * curve.marker) : around);
            before = here;
        }
    }
    for (const ChartLabel &end : at.panel.ends)
        placer.block({at.along(end.x), 0, 1, 1});
    return placer;
}

/// A label where there is room for it, in parts of the panel.
struct PlacedLabel {
    const ChartLabel &label;
    LabelPlacer::Box box;
    double x, y; ///< of its point
    /// From where another's label could stand.
    [[nodiscard]] bool far(const LaidOut &at) const {
        constexpr double pixels = 18;
        return std::hypot((nearest_x() - x) * at.wide(), (nearest_y() - y) * at.high()) >= pixels;
    }
    [[nodiscard]] double nearest_x() const { return std::clamp(x, box.x, box.x + box.width); }
    [[nodiscard]] double nearest_y() const { return std::clamp(y, box.y, box.y + box.height); }
    [[nodiscard]] double middle() const { return box.y + box.height / 2; }
};

constexpr double label_size = 10; // of the letters, pixels
constexpr double label_gap = 4;   // between these and what stands beside them, pixels

/// Labels beside their points, off the curves, as far as there is room.
std::vector<PlacedLabel> placed_labels(const LaidOut &at) {
    std::vector<PlacedLabel> placed;
    if (at.panel.labels.empty())
        return placed;
    LabelPlacer placer = occupied(at);
    placer.take({0, 0, 210 / at.wide(), 0.04 + 8 / at.high()}); // what says that some are left out
    for (const ChartLabel &label : at.panel.labels) {
        const double x = at.along(label.x);
        const double y = at.up(label.y);
        const auto box = placer.place(
            x, y, (text_width(label.text, label_size) + 2 * label_gap) / at.wide(), 15 / at.high());
        if (!box)
            continue;
        placed.push_back({label, *box, x, y});
    }
    return placed;
}

/// Labels with a line to their points where they stand far from them; those without room are
/// counted.
std::string labels_of(const LaidOut &at) {
    const std::vector<PlacedLabel> placed = placed_labels(at);
    std::string script;
    for (const PlacedLabel &one : placed) {
        script += fmt::format("set label {} at graph {},{} left font ',{}' textcolor '{}' front\n",
                              plot_text(one.label.text), one.box.x + label_gap / at.wide(),
                              one.middle(), label_size, one.label.colour);
        if (one.far(at))
            script += fmt::format("set arrow from graph {},{} to graph {},{} nohead lw 0.6 lc rgb "
                                  "'#999999'\n",
                                  one.x, one.y, one.nearest_x(), one.nearest_y());
    }
    return script +
           left_out(static_cast<int>(at.panel.labels.size() - placed.size()), "mark", "0.01,0.04");
}

/// A name at the end of a curve.
struct PlacedEnd {
    const ChartLabel &end;
    double y, place; ///< of the curve and of its name, parts of the panel
    bool top;        ///< the curve leaves there
};

std::vector<PlacedEnd> placed_ends(const LaidOut &at) {
    std::vector<PlacedEnd> ends;
    std::vector<double> wanted;
    for (const ChartLabel &end : at.panel.ends) {
        const double up = at.up(end.y);
        constexpr double border =
            1 - 1e-9; // of the panel: a curve is cut there by the same numbers
        if (up < 0 || up > 2 - border)
            continue;
        ends.push_back({end, up, up, up > border});
        if (!ends.back().top)
            wanted.push_back(up);
    }
    const double border = 8 / at.high(); // half of a letter
    // As far apart as the letters are high, or closer where they are too many.
    const double gap = std::min(
        15 / at.high(), (1 - 2 * border) / std::max(1.0, static_cast<double>(wanted.size()) - 1));
    const std::vector<double> places = spread(wanted, gap, {border, 1 - border});
    std::size_t next = 0;
    for (PlacedEnd &end : ends)
        if (!end.top)
            end.place = places[next++];
    return ends;
}

std::string ends_of(const LaidOut &at) {
    std::string script;
    for (const PlacedEnd &one : placed_ends(at)) {
        const double x = at.along(one.end.x);
        const double gap = end_gap / at.wide();
        script += fmt::format("set label {} at graph {},{} {} font ',{}' textcolor '{}'\n",
                              plot_text(one.end.text), one.top ? x - gap : x + gap,
                              one.top ? 0.975 : one.place, one.top ? "right" : "left", end_size,
                              one.end.colour);
        if (!one.top && std::abs(one.place - one.y) * at.high() > 5) // it had to give way
            script += fmt::format("set arrow from graph {},{} to graph {},{} nohead lw 0.6 lc rgb "
                                  "'{}'\n",
                                  x + 0.001, one.y, x + gap - 0.002, one.place, one.end.colour);
    }
    return script;
}

Json chart_axis_json(const ChartAxis &axis) {
    return {{"title", axis.title}, {"unit", axis.unit},  {"spin_speed", axis.spin_speed},
            {"low", axis.low},     {"high", axis.high},  {"logarithmic", axis.logarithmic},
            {"step", axis.step},   {"names", axis.names}};
}

Json chart_curve_json(const ChartCurve &curve) {
    return {{"name", curve.name},           {"points", curve.points},
            {"colour", curve.style.colour}, {"dash", curve.style.dash},
            {"point", curve.style.point},   {"width", curve.width},
            {"marker", curve.marker},       {"every", curve.every},
            {"texts", curve.texts},         {"filled", curve.filled}};
}

Json chart_panel_json(const LaidOut &at) {
    const ChartPanel &panel = at.panel;
    return {{"title", panel.title},
            {"height", panel.height},
            {"square", panel.square},
            {"x", chart_axis_json(panel.x)},
            {"y", chart_axis_json(panel.y)},
            {"curves", json_list(panel.curves, chart_curve_json)},
            {"labels", json_list(placed_labels(at),
                                 [&](const PlacedLabel &one) {
                                     return Json{
                                         {"text", one.label.text},
                                         {"x", one.label.x},
                                         {"y", one.label.y},
                                         {"colour", one.label.colour},
                                         {"right", (one.box.x - one.x) * at.wide() + label_gap},
                                         {"up", (one.middle() - one.y) * at.high()},
                                         {"far", one.far(at)}};
                                 })},
            {"ends", json_list(placed_ends(at), [&](const PlacedEnd &one) {
                 return Json{{"text", one.end.text},
                             {"x", one.end.x},
                             {"y", one.end.y},
                             {"colour", one.end.colour},
                             {"up", (one.place - one.y) * at.high()},
                             {"top", one.top}};
             })}};
}

} // namespace

ChartAxis chart_axis(const Units &units, const std::string &what, Quantity quantity) {
    return {.title = units.label(what, quantity),
            .unit = units.name(quantity),
            .spin_speed = quantity == Quantity::speed};
}

ChartAxis chart_axis(const Units &units, const std::string &what, Quantity quantity, double low,
                     double high) {
    ChartAxis axis = chart_axis(units, what, quantity);
    axis.low = units(quantity, low);
    axis.high = units(quantity, high);
    return axis;
}

ChartAxis phase_axis(const Units &units, const std::string &what) {
    ChartAxis axis = chart_axis(units, what, Quantity::angle);
    axis.low = -190;
    axis.high = 190;
    axis.step = 90;
    return axis;
}

ChartAxis along_speeds(const Units &units, const std::vector<double> &speeds) {
    const Range range = range_of(speeds);
    return chart_axis(units, "Spin speed", Quantity::speed, range.low, range.high);
}

ChartAxis along_axis(const Units &units, const model::SweepAxis &of) {
    return of.is_speed() && !of.dimensionless ? along_speeds(units, of.values)
                                              : ChartAxis{.title = axis_name(of),
                                                          .low = of.values.front(),
                                                          .high = of.values.back()};
}

ChartCurve chart_curve(const std::string &name, std::vector<PlotPoint> points, std::size_t index,
                       double width, const std::string &dash) {
    ChartCurve curve{name, std::move(points), series_style(index), width, 0};
    if (!dash.empty())
        curve.style.dash = dash;
    return curve;
}

ChartCurve branch_curve(const std::string &name, std::optional<bool> stable,
                        const std::string &colour) {
    return {name + (!stable   ? ", neither"
                    : *stable ? ", stable"
                              : ", unstable"),
            {},
            {"", colour,
             !stable   ? "(2,4)"
             : *stable ? "1"
                       : "(14,7)",
             !stable   ? 1
             : *stable ? 7
                       : 6},
            stable.value_or(false) ? 2.6 : 1.4};
}

ChartCurve level_line(const ChartPanel &panel, double y, const LineStyle &style, double width) {
    return {style.name, {{*panel.x.low, y}, {*panel.x.high, y}}, style, width};
}

ChartCurve upright_line(const ChartPanel &panel, double x, const LineStyle &style, double width) {
    return {style.name, {{x, panel.y.low}, {x, panel.y.high}}, style, width};
}

ChartCurve chart_area(const LineStyle &style, std::vector<PlotPoint> border) {
    ChartCurve area{style.name, std::move(border), style};
    area.filled = true;
    return area;
}

ChartCurve chart_bar(Range x, Range y, const LineStyle &style) {
    return chart_area(
        style,
        {{x.low, y.low}, {x.high, y.low}, {x.high, y.high}, {x.low, y.high}, {x.low, y.low}});
}

std::vector<ChartCurve> chart_map(const std::vector<double> &x, const std::vector<double> &y,
                                  const std::vector<std::vector<double>> &values,
                                  const std::vector<ChartLevel> &levels) {
    std::vector<ChartCurve> areas;
    for (const ChartLevel &level : levels)
        areas.push_back(chart_area(level.style));
    const auto edges = [](const std::vector<double> &places, std::size_t from, std::size_t to) {
        return Range{from == 0 ? places[from] : (places[from - 1] + places[from]) / 2,
                     to + 1 == places.size() ? places[to] : (places[to] + places[to + 1]) / 2};
    };
    const auto level_of = [&](double value) {
        const auto at = std::ranges::lower_bound(levels, value, {}, &ChartLevel::most);
        return std::isnan(value) ? areas.size() : static_cast<std::size_t>(at - levels.begin());
    };
    for (std::size_t j = 0; j < y.size(); ++j)
        for (std::size_t i = 0, last = 0; i < x.size(); i = last + 1) {
            const std::size_t level = level_of(values[j][i]);
            for (last = i; last + 1 < x.size() && level_of(values[j][last + 1]) == level;)
                ++last; // those beside each other as one
            if (level == areas.size())
                continue;
            add_part(areas[level].points, chart_bar(edges(x, i, last), edges(y, j, j), {}).points);
        }
    std::erase_if(areas, [](const ChartCurve &area) { return area.points.empty(); });
    return areas;
}

ChartCurve upright_band(const ChartPanel &panel, Range x, const LineStyle &style) {
    return chart_bar(x, {*panel.y.low, *panel.y.high}, style);
}

void add_piece(std::vector<PlotPoint> &line, const PlotPoint &from, const PlotPoint &to) {
    const bool on = !line.empty() && line.back().x == from.x && line.back().y == from.y;
    if (!on && !line.empty())
        line.push_back({from.x, std::nullopt});
    if (!on)
        line.push_back(from);
    line.push_back(to);
}

void add_part(std::vector<PlotPoint> &curve, const std::vector<PlotPoint> &part) {
    if (!curve.empty())
        curve.push_back({curve.back().x, std::nullopt});
    curve.insert(curve.end(), part.begin(), part.end());
}

void add_marks(ChartPanel &panel, const std::string &name, int point, std::vector<PlotPoint> at) {
    if (!at.empty())
        panel.curves.push_back({name, std::move(at), {"", "#222222", "1", point}, 0, 1.4});
}

ChartPanel polar_panel(int size, const ChartAxis &x, const ChartAxis &y, double largest) {
    largest = largest > 0 && std::isfinite(largest) ? largest : 1;
    ChartPanel panel{size, x, y};
    panel.square = true;
    for (ChartAxis *axis : {&panel.x, &panel.y}) {
        axis->high = 1.15 * largest;
        axis->low = -*axis->high;
    }
    const LineStyle grey{"", "#DDDDDD"};
    panel.curves = {level_line(panel, 0, grey, 0.8),
                    upright_line(panel, 0, grey, 0.8),
                    {"", circle_points(largest / 2), grey, 0.8},
                    {"", circle_points(largest), grey, 0.8}};
    return panel;
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

Figure chart_figure(const Chart &described, const model::Case &scene, const Units &units) {
    constexpr double beside_second = 95; // room of a second axis, pixels
    const Chart chart = prepared(described);
    double widest = text_width("operating speeds", picture_font); // in the legend
    double left = legended_left;
    double gap = 15; // from the panels to the legend
    for (const ChartPanel &panel : chart.panels) {
        for (const ChartCurve &curve : panel.curves)
            if (!curve.on_page)
                widest = std::max(widest, text_width(curve.name, picture_font));
        for (const auto &[at, name] : panel.y.names)
            left = std::max(left, text_width(name, picture_font) + 20);
        gap = panel.y.second ? 15 + beside_second : gap;
    }
    const std::vector<LaidOut> panels = laid_out(chart, left);
    int height = chart_head;
    for (const LaidOut &at : panels)
        height = at.top + at.panel.height +
                 (at.panel.x.title.empty() ? chart_below_numbers : chart_below_name);
    constexpr double sample = 62; // as gnuplot draws it: the line before a name and the gaps
    constexpr double least = 1080;
    const double right = left + panels_wide(chart) + gap;
    const double texts =
        std::max(text_width(chart.title, title_size), text_width(chart.subtitle, subtitle_size));
    double wide = std::max({least, right + sample + widest + 8, texts + 16});
    for (const LaidOut &at : panels)
        wide = std::max(wide, at.left + text_width(at.title, panel_title_size) + 8);
    wide = std::ceil(wide);
    std::string script =
        fmt::format("set multiplot\nset label 101 {} at screen 0.5,{} center font ',{}'\n"
                    "set label 102 {} at screen 0.5,{} center font ',{}' textcolor '#555555'\n"
                    "set grid lc rgb '#E4E4E4' lt 1 lw 0.6\n",
                    plot_text(chart.title), 1 - 22.0 / height, title_size,
                    plot_text(chart.subtitle), 1 - 48.0 / height, subtitle_size);
    std::set<std::string> keyed{""}; // names in the legend, each once
    for (const LaidOut &at : panels) {
        const ChartPanel &panel = at.panel;
        std::string data;
        std::vector<std::string> drawn; // with their data: gnuplot's elements of a plot
        for (const ChartCurve &curve : panel.curves) {
            if (curve.on_page)
                continue;
            const std::string block = fmt::format("curve{}", drawn.size());
            data += data_block(block, curve.points);
            drawn.push_back(fmt::format(
                "${} {} {}", block, chart_look(curve),
                keyed.insert(curve.name).second ? "title " + plot_text(curve.name) : "notitle"));
        }
        script += fmt::format("set lmargin at screen {}\nset rmargin at screen {}\n"
                              "set bmargin at screen {}\nset tmargin at screen {}\n",
                              at.left / wide, at.right / wide, 1 - (at.top + at.high()) / height,
                              1 - double(at.top) / height) +
                  axis_commands(panel.x, at.x, 'x', draws_nothing(panel)) +
                  axis_commands(panel.y, at.y, 'y', draws_nothing(panel)) +
                  fmt::format("set key at graph {},1 left top reverse Left vertical samplen 3\n",
                              (right - at.left) / at.wide()) +
                  (at.title.empty() ? ""
                                    : fmt::format("set label {} at screen {},{} left font ',{}'\n",
                                                  plot_text(at.title), at.left / wide,
                                                  1 - (at.top - 12.0) / height, panel_title_size));
        for (const bool along_x : {true, false})
            if ((along_x ? panel.x : panel.y).spin_speed) {
                const Range &speeds = along_x ? at.x : at.y;
                script +=
                    operation_band(scene, units, speeds, along_x ? SpeedAxis::x : SpeedAxis::y);
                if (keyed.insert("operating speeds").second)
                    drawn.push_back(operation_key(scene, units, speeds));
            }
        std::erase(drawn, "");
        script += labels_of(at) + ends_of(at) + data + "plot " +
                  (drawn.empty() ? "NaN notitle" : joined(drawn, ", ")) +
                  "\nunset object\nunset arrow\nunset label\n";
    }
    if (chart.panels.empty())
        script += "set xrange [0:1]\nset yrange [0:1]\nset label 'nothing to draw' at graph "
                  "0.5,0.5 center\nplot NaN notitle\n";
    return {script + "unset multiplot\n", static_cast<int>(wide), height};
}

Json chart_json(const Chart &described) {
    const Chart chart = prepared(described);
    return {{"apart", chart.apart},
            {"panels", json_list(laid_out(chart, legended_left), chart_panel_json)}};
}

} // namespace whirl::report
