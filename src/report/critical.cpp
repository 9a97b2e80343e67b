// Report of the command critical.

#include "results/critical.h"

#include "report/common/csv.h"
#include "report/common/error_parts.h"
#include "report/common/margins.h"
#include "report/common/table.h"
#include "report/common/text_width.h"
#include "report/common/words.h"
#include "report/critical_map.h"
#include "report/pictures/labels.h"
#include "report/pictures/operation.h"
#include "report/pictures/style.h"
#include "report/reports.h"
#include "results/whirl.h"

#include <fmt/format.h>

#include <algorithm>

namespace whirl::report {

using results::CriticalResult;
using results::CriticalSpeed;

namespace {

const Columns<CriticalSpeed> critical_columns = with_error_parts<CriticalSpeed>(
    {{OnPage("No."), InText(""), [](const auto &, std::size_t i) { return i + 1; }},
     {"speed", InCsv("speed"), OnPage("", "{:.10g}").and_si("{:.10g}"), InText("").and_si(precise),
      Quantity::speed, &CriticalSpeed::speed},
     {OnPage("", "{:.10g}"), InText(""), Quantity::frequency, &CriticalSpeed::speed},
     {"mode", InCsv("mode"), OnPage("Mode"), InText("mode"),
      [](const auto &c) { return known_name(c.mode); }},
     {"whirl", InCsv("whirl"), &CriticalSpeed::whirl},
     {OnPage("Whirl"), InText("whirl"), whirl_of},
     {"real", InCsv("real"), OnPage("Real part", "{:.5g}"), Quantity::rate, &CriticalSpeed::real},
     {"damping_ratio", InCsv("damping_ratio"), OnPage("Damping ratio"), InText("damping ratio"),
      Quantity::number, [](const auto &c) { return c.damping.ratio; }},
     {"log_dec", InCsv("log_dec"), Quantity::number,
      [](const auto &c) { return c.damping.log_dec; }},
     {"amplification", InCsv("amplification"), OnPage("Amplification factor", "{:.5g}"),
      InText("amplification", "{:.5g}"), Quantity::number,
      [](const auto &c) { return c.damping.amplification; }},
     {"heavily_damped", InCsv("heavily_damped"), [](const auto &c) { return c.damping.heavy(); }},
     {OnPage("Damped"), InText("damped"),
      [](const auto &c) { return c.damping.heavy() ? "heavily" : ""; }},
     {"error", InCsv("error"), OnPage("Relative error", "{:.2g}"), InText("error", rough),
      Quantity::number, &CriticalSpeed::error},
     {"residual", InCsv("residual"), Quantity::number, &CriticalSpeed::residual},
     {"plane", InCsv("plane"), Quantity::angle, &CriticalSpeed::plane}},
    error_part);

std::string text_of(const model::Case &scene, const CriticalResult &result, const Units &units) {
    return heading(scene, "Critical speeds") +
           (result.critical_speeds.empty()
                ? "  none found\n"
                : text_table(critical_columns, result.critical_speeds, units)) +
           margins_text(result.margins, units) +
           (result.map ? critical_map_text(scene, *result.map, units) : "") +
           model_text(result.model, units);
}

/// The senses of whirl that there are, each with a row of marks, from the bottom.
std::vector<results::Whirl> senses_of(const CriticalResult &result) {
    std::vector<results::Whirl> senses{results::Whirl::backward, results::Whirl::mixed,
                                       results::Whirl::forward};
    std::erase_if(senses, [&result](results::Whirl sense) {
        return std::ranges::find(result.critical_speeds, sense, &CriticalSpeed::whirl) ==
               result.critical_speeds.end();
    });
    return senses;
}

/// The panel of the marks: pixels, and its rows.
struct MarksPanel {
    std::vector<results::Whirl> senses;
    static constexpr int width = 1080;
    static constexpr double left = 0.1, right = 0.965, wide = (right - left) * width;
    static constexpr int head = 96, foot = 72, row_height = 66;
    static constexpr double from = 0.4, beyond = 0.9; ///< of the rows, below and above
    [[nodiscard]] double to() const { return static_cast<double>(senses.size()) + beyond; }
    [[nodiscard]] double high() const { return row_height * (to() - from); }
    [[nodiscard]] int height() const { return head + foot + static_cast<int>(high()); }
    [[nodiscard]] int row(results::Whirl sense) const {
        return 1 + static_cast<int>(std::ranges::find(senses, sense) - senses.begin());
    }
    [[nodiscard]] double up(double row) const { return (row - from) / (to() - from); }
    [[nodiscard]] std::string names() const {
        return joined(senses, ", ", [this](results::Whirl sense) {
            return fmt::format("'{}' {}", results::whirl_name(sense), row(sense));
        });
    }
};

/// Speeds of the marks. Logarithmic where the highest is so much higher than the lowest that
/// this would stand at the edge with its neighbours on it.
struct MarksAxis {
    Range x;
    bool logarithmic = false;
    /// Fraction of the panel.
    [[nodiscard]] double across(double speed) const {
        return logarithmic ? std::log(speed / x.low) / std::log(x.high / x.low)
                           : (speed - x.low) / (x.high - x.low);
    }
};

MarksAxis axis_of(const model::Case &scene, const Units &units, const CriticalResult &result) {
    constexpr double wide = 100;
    double highest = scene.operation ? units(Quantity::speed, scene.operation->to) : 0;
    double lowest = HUGE_VAL;
    for (const auto &critical : result.critical_speeds) {
        highest = std::max(highest, units(Quantity::speed, critical.speed));
        lowest = std::min(lowest, units(Quantity::speed, critical.speed));
    }
    if (lowest > 0 && lowest < HUGE_VAL && highest > wide * lowest)
        return {{lowest / 2, 2 * highest}, true};
    return {{0, highest > 0 ? 1.06 * highest : 1}, false};
}

/// The speeds beside their marks: above, else below, else farther away; those that find no place
/// are counted.
std::string speed_labels(const Units &units, const CriticalResult &result, const MarksAxis &axis,
                         const MarksPanel &panel) {
    constexpr double size = 10;
    LabelPlacer placer;
    std::string script;
    int unnamed = 0;
    for (const CriticalSpeed &critical : result.critical_speeds) {
        const std::string text = drawn_speed(units, critical.speed);
        const double width = (text_width(text, size) + 6) / MarksPanel::wide;
        const double across = axis.across(units(Quantity::speed, critical.speed));
        bool placed = false;
        for (const double off : {0.33, -0.33, 0.52, -0.52}) { // of the distance of the rows
            const double up = panel.up(panel.row(critical.whirl) + off);
            placed =
                placer.take({across - width / 2, up - 6 / panel.high(), width, 12 / panel.high()});
            if (!placed)
                continue;
            script += fmt::format("set label {} at graph {},{} center font ',{}' textcolor '{}'\n",
                                  plot_text(text), across, up, size,
                                  critical.damping.heavy() ? heavy_colour : "#000000");
            break;
        }
        unnamed += placed ? 0 : 1;
    }
    return script + left_out(unnamed, "number", "0,1.06");
}

/// The critical speeds as marks on a speed axis, forward and backward in rows of their own.
Figure critical_figure(const model::Case &scene, const CriticalResult &result, const Units &units) {
    const MarksAxis axis = axis_of(scene, units, result);
    const MarksPanel panel{senses_of(result)};
    const Range &x = axis.x;
    Curves drawn;
    drawn.add("NaN notitle");
    drawn.add(operation_key(scene, units, x));
    std::vector<PlotPoint> heavy;
    for (const auto sense : panel.senses) {
        std::vector<PlotPoint> points;
        for (const auto &critical : result.critical_speeds) {
            if (critical.whirl != sense)
                continue;
            const bool grey = critical.damping.heavy();
            (grey ? heavy : points)
                .push_back({units(Quantity::speed, critical.speed), panel.row(sense)});
        }
        const LineStyle style = whirl_style(sense);
        drawn.add(points, fmt::format("with points pt {} ps 1.5 lw 1.6 lc rgb '{}'", style.point,
                                      style.colour));
    }
    if (!heavy.empty())
        drawn.add(heavy, fmt::format("with points pt 6 ps 1.5 lw 1.6 lc rgb '{}'", heavy_colour),
                  "'heavily damped (AF < 2.5)'");
    return figure_of(panel.width, panel.height(), "Critical speeds: " + title_of(scene),
                     "synchronous whirl, 1×",
                     panel_margins(panel.left, panel.right, double(panel.foot) / panel.height(),
                                   1 - double(panel.head) / panel.height()) +
                         (axis.logarithmic ? "set logscale x\nset format x '10^{%L}'\n" : "") +
                         fmt::format("set xrange [{}:{}]\nset yrange [{}:{}]\n"
                                     "set ytics ({})\n"
                                     "set xlabel {}\nset grid x lc rgb '#E4E4E4' lt 1\n"
                                     "set key at graph 1,1.02 right bottom horizontal samplen 2\n",
                                     x.low, x.high, panel.from, panel.to(), panel.names(),
                                     axis_text(units, "Spin speed", Quantity::speed)) +
                         operation_band(scene, units, x) +
                         speed_labels(units, result, axis, panel) + drawn.script());
}

/// The critical speeds and what their margins come to, in one sentence.
model::Sentence answer_of(const CriticalResult &result) {
    namespace as = model::as;
    constexpr std::size_t most = 8; // in a sentence
    std::vector<double> sharp;
    for (const CriticalSpeed &critical : result.critical_speeds)
        if (!critical.damping.heavy())
            sharp.push_back(critical.speed);
    const std::size_t all = sharp.size();
    sharp.resize(std::min(all, most));
    model::Sentence answer =
        all == 0      ? model::Sentence("no critical speed that is not heavily damped")
        : all <= most ? model::Sentence("critical speeds at {}", as::speed.list(sharp, 5))
                      : model::Sentence("critical speeds at {} and {} more",
                                        as::speed.list(sharp, 5), all - most);
    if (!result.margins)
        return answer;
    const auto failing =
        std::ranges::count(*result.margins, false, &results::SeparationMargin::passes);
    return answer += result.margins->empty() ? model::Sentence("; none needs a separation margin")
                     : failing == 0
                         ? model::Sentence("; each has the separation margin that it must have")
                         : model::Sentence("; {} of {} separation margins {} too small", failing,
                                           result.margins->size(), failing == 1 ? "is" : "are");
}

std::vector<Section> brief_of(const CriticalResult &result, const Units &units) {
    std::vector<Section> sections;
    if (result.margins)
        sections.push_back({margins_heading, margins_page(*result.margins, units)});
    if (!result.critical_speeds.empty())
        sections.push_back({"Critical speeds", page_table_of_first(brief_rows, critical_columns,
                                                                   result.critical_speeds, units)});
    return sections;
}

} // namespace

Report describe(const model::Case &scene, const CriticalResult &result) {
    const auto &speeds = result.critical_speeds;
    Report report{
        .command = "critical",
        .heading = "Critical speeds",
        .scene = &scene,
        .model = &result.model,
        .json =
            [&](const Units &units) {
                Json json{{"critical_speeds", json_rows(critical_columns, speeds, units)}};
                add_margins(json, result.margins, units);
                if (result.map)
                    json["map"] = critical_map_json(scene, *result.map, units);
                return json;
            },
        .csv = [&](const Units &units) { return csv_table(critical_columns, speeds, units); },
        .sections =
            [&](const Units &units) {
                std::vector sections{Section{"Table", page_table(critical_columns, speeds, units)}};
                if (result.margins)
                    sections.push_back({margins_heading, margins_page(*result.margins, units)});
                if (result.map)
                    for (Section &section : critical_map_sections(scene, *result.map, units))
                        sections.push_back(std::move(section));
                return sections;
            },
        .text = [&](const Units &units) { return text_of(scene, result, units); },
        .figure = [&](const Units &units) { return critical_figure(scene, result, units); }};
    if (result.map) {
        report.pictures = [&](const Units &units) {
            return std::vector{critical_map_picture(scene, *result.map, units)};
        };
        report.pictures_heading = "Critical speed map";
        report.pictures_after = result.margins ? 2 : 1;
    }
    report.answer = answer_of(result);
    report.brief = [&](const Units &units) { return brief_of(result, units); };
    return report;
}

} // namespace whirl::report
