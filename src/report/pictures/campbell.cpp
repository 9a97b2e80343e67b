#include "report/pictures/figures.h"

#include "report/common/text_width.h"
#include "report/common/words.h"
#include "report/pictures/campbell_panel.h"
#include "report/pictures/labels.h"
#include "report/pictures/operation.h"
#include "report/pictures/style.h"
#include "results/campbell.h"
#include "results/formulation.h"
#include "results/whirl.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace whirl::report {

using results::CampbellMode;
using results::CampbellResult;
using results::Whirl;

namespace {

constexpr int figure_width = 1080;
constexpr Whirl senses[] = {Whirl::forward, Whirl::backward, Whirl::mixed};
constexpr double name_size = 11;      ///< of the names beside the ends of the curves
constexpr double name_gap = 0.022;    ///< from the curves to their names, of the panel
constexpr double panel_pixels = 868;  ///< its width
constexpr double log_dec_limit = 6.3; ///< higher decrements (damping ratio > 0.7) are cut off

bool has_sense(const CampbellResult &result, Whirl sense) {
    return std::any_of(result.modes.begin(), result.modes.end(), [&](const CampbellMode &mode) {
        return std::find(mode.whirl.begin(), mode.whirl.end(), sense) != mode.whirl.end();
    });
}

bool has_growth(const CampbellResult &result) {
    return std::any_of(result.modes.begin(), result.modes.end(), [&](const CampbellMode &mode) {
        for (std::size_t i = 0; i < result.speeds.size(); ++i)
            if (grows(mode, i))
                return true;
        return false;
    });
}

/// Where a motion grows at one speed and at neither neighbour: a band as narrow as that is no line.
std::vector<PlotPoint> lone_growth(const Panel &panel, const CampbellResult &result) {
    std::vector<PlotPoint> points;
    for (const CampbellMode &mode : result.modes)
        for (std::size_t i = 0; i < result.speeds.size(); ++i)
            if (grows(mode, i) && !(i > 0 && grows(mode, i - 1)) && !grows(mode, i + 1))
                points.push_back({panel.speed(result.speeds[i]), panel.value(mode, i)});
    return points;
}

/// @param key  with the legend entries
void add_curves(const Panel &panel, const CampbellResult &result, bool key, Curves &drawn) {
    const auto entry_of = [&](const std::string &look, const std::string &title) {
        if (key)
            drawn.add(fmt::format("keyentry {} title '{}'", look, title));
    };
    if (has_growth(result)) {
        const std::string look = "with lines lw 9 lc rgb '#60E0208A'";
        drawn.add_pieces(stretches(panel, result,
                                   [](const auto &mode, std::size_t i) {
                                       return grows(mode, i) && grows(mode, i + 1);
                                   }),
                         look);
        drawn.add(lone_growth(panel, result), "with points pt 7 ps 1.4 lc rgb '#60E0208A'");
        entry_of(look, "unstable");
    }
    if (const auto others = other_frequencies(panel, result); !others.empty()) {
        const std::string look = "with lines lw 1.2 dt (2,3) lc rgb '#707070'";
        drawn.add_pieces(others, look);
        entry_of(look, "its other frequency");
    }
    for (const Whirl sense : senses) {
        if (!has_sense(result, sense))
            continue;
        const LineStyle style = whirl_style(sense);
        const std::string mark = fmt::format("pt {} ps 0.8", style.point);
        drawn.add_pieces(stretches(panel, result,
                                   [&](const auto &mode, std::size_t i) {
                                       return i < mode.whirl.size() && mode.whirl[i] == sense;
                                   }),
                         line_look(style, 1.8));
        drawn.add(markers(panel, result, sense),
                  fmt::format("with points {} lc rgb '{}' lw 1.4", mark, style.colour));
        entry_of(fmt::format("with linespoints lc rgb '{}' lw 1.8 dt {} {}", style.colour,
                             style.dash, mark),
                 style.name);
    }
}

std::vector<double> multiples_of(const model::Case &scene) {
    std::vector<double> multiples = scene.campbell.multiples;
    if (std::find(multiples.begin(), multiples.end(), 1.0) == multiples.end())
        multiples.push_back(1.0);
    return multiples;
}

/// Of the speed range, right of the curves, for the names.
double label_strip(const Units &units, const CampbellResult &result) {
    double widest = text_width("10×", name_size);
    for (const CampbellMode &mode : result.modes)
        if (!mode.frequency.empty() && mode.frequency.back())
            widest = std::max(widest, text_width(end_name(units, mode), name_size));
    const double strip = name_gap * panel_pixels + widest + 8;
    return strip / (panel_pixels - strip);
}

/// Names of modes, and of multiples that leave the panel at the right, beside the curves' ends.
std::string end_labels(const Panel &panel, const model::Case &scene, const CampbellResult &result) {
    struct End {
        std::string text, colour;
        double height;
    };
    std::vector<End> ends;
    const double last = result.speeds.empty() ? 0 : result.speeds.back();
    const double end_of_curves = panel.across(panel.speed(last));
    for (const CampbellMode &mode : result.modes) {
        const auto value = panel.value(mode, result.speeds.size() - 1);
        if (value && *value >= panel.y.low && *value <= panel.y.high && !mode.whirl.empty())
            ends.push_back({end_name(panel.units, mode), whirl_style(mode.whirl.back()).colour,
                            panel.up(*value)});
    }
    if (!panel.damping)
        for (const double multiple : multiples_of(scene))
            if (const double value = panel.frequency(multiple * last); value <= panel.y.high)
                ends.push_back({drawn_number(multiple) + "×", "#555555", panel.up(value)});
    std::vector<double> wanted;
    for (const End &end : ends)
        wanted.push_back(end.height);
    const double border = 8 / panel.pixels_high; // half of a letter
    // As far apart as the letters are high, or closer where they are too many.
    const double gap =
        std::min(15 / panel.pixels_high,
                 (1 - 2 * border) / std::max(1.0, static_cast<double>(ends.size()) - 1));
    const auto places = spread(wanted, gap, {border, 1 - border});
    std::string script;
    for (std::size_t i = 0; i < ends.size(); ++i) {
        script += fmt::format("set label {} at graph {},{} left font ',{}' textcolor '{}'\n",
                              plot_text(ends[i].text), end_of_curves + name_gap, places[i],
                              name_size, ends[i].colour);
        // From the end of the curve to a name that had to give way.
        if (std::abs(places[i] - ends[i].height) * panel.pixels_high > 5)
            script += fmt::format("set arrow from graph {},{} to graph {},{} nohead lw 0.6 "
                                  "lc rgb '{}'\n",
                                  end_of_curves + 0.001, ends[i].height,
                                  end_of_curves + name_gap - 0.002, places[i], ends[i].colour);
    }
    return script;
}

/// Lines y = multiple * speed; the name stands inside the top where the line leaves there.
std::string multiple_lines(const Panel &panel, const model::Case &scene, double last) {
    const double slope = panel.frequency(1) / panel.speed(1);
    std::string script;
    for (const double multiple : multiples_of(scene)) {
        const double end = std::min(last, panel.y.high / slope / multiple);
        if (end <= panel.x.low)
            continue;
        const double start = std::max(panel.x.low, 0.0);
        script += fmt::format("set arrow from {},{} to {},{} nohead back dt (9,7) lw 1.2 "
                              "lc rgb '#777777'\n",
                              start, multiple * slope * start, end, multiple * slope * end);
        if (end < last)
            script += fmt::format("set label {} at {}, graph 0.975 right offset -1.2,0 "
                                  "font ',11' textcolor '#555555'\n",
                                  plot_text(drawn_number(multiple) + "×"), end);
    }
    return script;
}

/// Keeps labels off the curves, the spin lines and the crossings themselves.
LabelPlacer occupied(const Panel &panel, const model::Case &scene, const CampbellResult &result) {
    LabelPlacer placer;
    const auto block = [&](double speed, double frequency, double pixels) {
        const double width = pixels / panel.pixels_wide;
        const double height = pixels / panel.pixels_high;
        placer.block(
            {panel.across(speed) - width / 2, panel.up(frequency) - height / 2, width, height});
    };
    for (const CampbellMode &mode : result.modes)
        for (std::size_t i = 0; i < result.speeds.size(); ++i)
            if (const auto value = panel.value(mode, i))
                block(panel.speed(result.speeds[i]), *value, 5);
    for (const double multiple : multiples_of(scene))
        for (int i = 0; i <= 120; ++i) {
            const double speed = i / 120.0 * panel.x.high;
            block(speed, multiple * speed * panel.frequency(1) / panel.speed(1), 5);
        }
    for (const auto &crossing : result.crossings)
        block(panel.speed(crossing.speed), panel.frequency(crossing.frequency), 12);
    if (!result.speeds.empty()) // the strip of the mode names
        placer.block({panel.across(panel.speed(result.speeds.back())), 0, 1, 1});
    return placer;
}

/// Circles at the crossings, black where a margin counts, grey where damping is so heavy that none
/// is needed; and from a frequency on, in its unit, their speeds at places clear of curves.
std::string crossing_marks(const Panel &panel, const model::Case &scene,
                           const CampbellResult &result, double named_above, bool key,
                           Curves &drawn) {
    LabelPlacer placer = occupied(panel, scene, result);
    std::string script;
    std::vector<PlotPoint> points;
    std::vector<PlotPoint> heavy;
    int unnamed = 0;
    for (const auto &crossing : result.crossings) {
        const PlotPoint at{panel.speed(crossing.speed), panel.frequency(crossing.frequency)};
        const double x = panel.across(at.x);
        const double y = panel.up(*at.y);
        if (y <= 0 || y >= 1)
            continue;
        (crossing.damping.heavy() ? heavy : points).push_back(at);
        if (*at.y < named_above)
            continue;
        const std::string text =
            drawn_speed(panel.units, crossing.speed) + " " + panel.units.name(Quantity::speed);
        const auto box = placer.place(x, y, (text_width(text, 10) + 8) / panel.pixels_wide,
                                      17 / panel.pixels_high);
        if (!box) {
            ++unnamed;
            continue;
        }
        const double middle = box->y + box->height / 2;
        script += fmt::format("set label {} at graph {},{} left font ',10' textcolor '{}'\n",
                              plot_text(text), box->x, middle,
                              crossing.damping.heavy() ? heavy_colour : "#000000");
        script += leader(*box, x, y);
    }
    if (unnamed > 0)
        script +=
            fmt::format("set label '{} more crossings: see the report' at graph 0.012,0.965 left "
                        "font ',10' textcolor '#555555'\n",
                        unnamed);
    const auto add = [&](const std::vector<PlotPoint> &circles, bool grey, const char *title) {
        const bool any = std::ranges::any_of(
            result.crossings, [grey](const auto &at) { return at.damping.heavy() == grey; });
        drawn.add(circles,
                  fmt::format("with points pt 6 ps 1.7 lw 1.6 lc rgb '{}'",
                              grey ? heavy_colour : "#000000"),
                  key && any ? title : "");
    };
    add(heavy, true, "'heavily damped'");
    add(points, false, "'crossing'");
    return script;
}

std::string axes(const Panel &panel, bool first, bool last) {
    std::string script =
        axes_over(panel.x, panel.y) + "set xtics nomirror\nset ytics nomirror\n" + grid;
    const Units &units = panel.units;
    script += last ? "set xlabel " + axis_text(units, "Spin speed", Quantity::speed) + "\n"
                   : "unset xlabel\n";
    // Second axes in the units of theory, where no others were asked for.
    if (first && !units.asked(Quantity::speed))
        script += fmt::format("set x2range [{}:{}]\nset x2tics\nset x2label {} offset 0,-0.4\n",
                              panel.x.low / panel.speed(1), panel.x.high / panel.speed(1),
                              axis_text({}, "Spin speed", Quantity::speed));
    else
        script += "unset x2tics\nunset x2label\n";
    // Long numbers would push the name of the axis out, which is then not drawn at all.
    const double longest = units.asked(Quantity::frequency) ? 2e4 : 1e6;
    script += panel.y.high >= longest && !panel.damping
                  ? "set format y '%.1s%c'\nset format y2 '%.1s%c'\n"
                  : "set format y\nset format y2\n";
    if (panel.damping)
        return script + "set ytics mirror\nunset y2tics\nunset y2label\n"
                        "set ylabel 'Logarithmic decrement'\n";
    script += "set ylabel " + axis_text(units, "Whirl frequency", Quantity::frequency) + "\n";
    if (units.asked(Quantity::frequency))
        return script + "set ytics mirror\nunset y2tics\nunset y2label\n";
    return script + fmt::format("set y2range [{}:{}]\nset y2tics\n"
                                "set y2label 'Whirl frequency (cycles/min)'\n",
                                30 / pi / panel.frequency(1) * panel.y.low,
                                30 / pi / panel.frequency(1) * panel.y.high);
}

std::string draw(const Panel &panel, const model::Case &scene, const CampbellResult &result,
                 bool first, bool last, double named_above) {
    const double end = result.speeds.empty() ? 0 : panel.speed(result.speeds.back());
    std::string script =
        panel_margins(0.088, 0.088 + panel_pixels / figure_width, panel.bottom, panel.top);
    script += operation_band(scene, panel.units, {panel.x.low, end});
    script += axes(panel, first, last) + end_labels(panel, scene, result);
    Curves drawn;
    add_curves(panel, result, first, drawn);
    if (panel.damping) {
        // The limit of stability, as far as there are curves and not through their names.
        script += fmt::format("set arrow from {},0 to {},0 nohead back lw 1 lc rgb '#555555'\n",
                              panel.x.low, end > panel.x.low ? end : panel.x.high);
    } else {
        script += multiple_lines(panel, scene, end) +
                  crossing_marks(panel, scene, result, named_above, first, drawn);
    }
    const double pixel = (panel.top - panel.bottom) / panel.pixels_high;
    script += first
                  ? fmt::format("set key at screen 0.49,{} center center horizontal samplen 4\n",
                                panel.top + (panel.units.asked(Quantity::speed) ? 40 : 84) * pixel)
                  : "unset key\n";
    if (first)
        drawn.add(operation_key(scene, panel.units, {panel.x.low, end}));
    return script + drawn.script() + "unset label\nunset arrow\nunset object\n";
}

/// The panels this result needs, from top to bottom, without their places in the figure.
std::vector<Panel> panels_of(const CampbellResult &result, const Units &units) {
    double highest = 0;
    double lowest = HUGE_VAL;
    double largest_decrement = 0;
    double smallest_decrement = 0;
    for (const CampbellMode &mode : result.modes) {
        for (const auto &frequency : mode.frequency)
            if (const double here = units(Quantity::frequency, frequency.value_or(0)); frequency) {
                highest = std::max(highest, here);
                lowest = std::min(lowest, here);
            }
        for (const auto &decrement : mode.log_dec) {
            largest_decrement = std::max(largest_decrement, decrement.value_or(0));
            smallest_decrement = std::min(smallest_decrement, decrement.value_or(0));
        }
    }
    Range x = speed_range(units, result.speeds);
    x.high += label_strip(units, result) * (x.high - x.low);
    std::vector<Panel> panels{{units, false, x, {0, highest > 0 ? 1.05 * highest : 1}}};
    // Where what happens at the spin speed is low down, or all crossings are, that part alone.
    double reach = result.speeds.empty() ? 0 : units(Quantity::frequency, result.speeds.back());
    double crossed = 0;
    for (const auto &crossing : result.crossings)
        crossed = std::max(crossed, units(Quantity::frequency, crossing.frequency));
    if (crossed > 0 && crossed < 0.3 * reach)
        reach = 1.5 * crossed;
    if (reach > 0 && reach < 0.22 * highest && lowest < 1.35 * reach)
        panels.push_back({units, false, x, {0, 1.35 * reach}});
    if (largest_decrement > 1e-9 || smallest_decrement < -1e-9) {
        const double top = 1.08 * std::min(largest_decrement, log_dec_limit);
        const double bottom = 1.35 * std::max(smallest_decrement, -log_dec_limit);
        panels.push_back({units, true, x, {std::min(bottom, -0.04 * top), std::max(top, 0.02)}});
    }
    return panels;
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

Figure campbell_figure(const model::Case &scene, const CampbellResult &result, const Units &units) {
    std::vector<Panel> panels = panels_of(result, units);
    // Two rows of the key, and a second axis of the speed.
    const double head = units.asked(Quantity::speed) ? 128 : 172;
    const double foot = 62;
    const double gap = 34;
    const double first = 500;
    const double other = 270;
    const int height = static_cast<int>(head + first + foot +
                                        (static_cast<double>(panels.size()) - 1) * (other + gap));
    double top = height - head;
    for (Panel &panel : panels) {
        panel.pixels_high = &panel == &panels.front() ? first : other;
        panel.pixels_wide = panel_pixels;
        panel.top = top / height;
        panel.bottom = (top - panel.pixels_high) / height;
        top -= panel.pixels_high + gap;
    }
    // Crossings that the low panel shows larger get their names there.
    const bool low = panels.size() > 1 && !panels[1].damping;
    std::string script;
    for (const Panel &panel : panels)
        script += draw(panel, scene, result, &panel == &panels.front(), &panel == &panels.back(),
                       low && &panel == &panels.front() ? panels[1].y.high : 0);
    return figure_of(figure_width, height, "Campbell diagram: " + title_of(scene),
                     fmt::format("{} form, shaft order {}, {} elements, {} unknowns",
                                 results::form_name(result.model.formulation.form),
                                 result.model.order, result.model.elements, result.model.unknowns),
                     script);
}

} // namespace whirl::report
