// Report of the command critical.

#include "results/critical.h"

#include "report/common/csv.h"
#include "report/common/error_parts.h"
#include "report/common/margins.h"
#include "report/common/words.h"
#include "report/critical_map.h"
#include "report/pictures/chart.h"
#include "report/pictures/style.h"
#include "report/reports.h"
#include "report/sections.h"
#include "results/whirl.h"

#include <fmt/format.h>

#include <algorithm>

namespace whirl::report {

using model::Sentence;
using results::CriticalResult;
using results::CriticalSpeed;
using results::SeparationMargin;

namespace {

const Columns<CriticalSpeed> critical_columns = with_error_parts<CriticalSpeed>(
    {{OnPage("No."), InText(""), [](const auto &, std::size_t i) { return i + 1; }},
     {InFiles("speed"), AllDigits(""), Quantity::speed, &CriticalSpeed::speed},
     {OnPage("", "{:.10g}"), InText(""), Quantity::frequency, &CriticalSpeed::speed},
     {InFiles("mode"), Titled("Mode"), [](const auto &c) { return known_name(c.mode); }},
     {InFiles("whirl"), &CriticalSpeed::whirl},
     {Titled("Whirl"), whirl_of},
     {InFiles("real"), OnPage("Real part", "{:.5g}"), Quantity::rate, &CriticalSpeed::real},
     {InFiles("damping_ratio"), Titled("Damping ratio"), Quantity::number,
      [](const auto &c) { return c.damping.ratio; }},
     {InFiles("log_dec"), Quantity::number, [](const auto &c) { return c.damping.log_dec; }},
     {InFiles("amplification"), OnPage("Amplification factor", "{:.5g}"),
      InText("amplification", "{:.5g}"), Quantity::number,
      [](const auto &c) { return c.damping.amplification; }},
     {InFiles("heavily_damped"), [](const auto &c) { return c.damping.heavy(); }},
     {Titled("Damped"), [](const auto &c) { return c.damping.heavy() ? "heavily" : ""; }},
     {InFiles("error"), RelativeError(), &CriticalSpeed::error},
     {InFiles("residual"), Quantity::number, &CriticalSpeed::residual},
     {InFiles("plane"), Quantity::angle, &CriticalSpeed::plane}},
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

/// The critical speeds as marks on a speed axis, backward, mixed and forward in rows of their own.
Chart critical_chart(const model::Case &scene, const CriticalResult &result, const Units &units) {
    constexpr double wide = 100; // so much higher than the lowest, the highest would stand at the
                                 // edge of a linear axis with its neighbours on it
    double highest = scene.operation ? units(Quantity::speed, scene.operation->to) : 0;
    double lowest = HUGE_VAL;
    for (const CriticalSpeed &critical : result.critical_speeds) {
        highest = std::max(highest, units(Quantity::speed, critical.speed));
        lowest = std::min(lowest, units(Quantity::speed, critical.speed));
    }
    ChartPanel panel{66, chart_axis(units, "Spin speed", Quantity::speed), {}, {}};
    panel.x.logarithmic = lowest > 0 && lowest < HUGE_VAL && highest > wide * lowest;
    panel.x.low = panel.x.logarithmic ? lowest / 2 : lowest < 0 ? 1.06 * lowest : 0;
    panel.x.high = panel.x.logarithmic ? 2 * highest
                   : highest > 0       ? 1.06 * highest
                   : lowest < 0        ? 0
                                       : 1;
    ChartCurve heavy{"heavily damped (AF < 2.5)", {}, {"", heavy_colour, "1", 6}, 0, 1.5};
    double row = 0;
    for (const auto sense :
         {results::Whirl::backward, results::Whirl::mixed, results::Whirl::forward}) {
        if (std::ranges::find(result.critical_speeds, sense, &CriticalSpeed::whirl) ==
            result.critical_speeds.end())
            continue;
        ChartCurve marks{"", {}, whirl_style(sense), 0, 1.5};
        panel.y.names.emplace_back(++row, marks.style.name);
        for (const CriticalSpeed &critical : result.critical_speeds) {
            if (critical.whirl != sense)
                continue;
            ChartCurve &of = critical.damping.heavy() ? heavy : marks;
            const double speed = units(Quantity::speed, critical.speed);
            of.points.push_back({speed, row});
            of.texts.push_back(fmt::format("{}: {}\nerror {}", marks.style.name,
                                           units.text(Quantity::speed, critical.speed, 10),
                                           readable(critical.error, 2)));
            panel.labels.push_back({drawn_speed(units, critical.speed), speed, row,
                                    critical.damping.heavy() ? heavy_colour : "#000000"});
        }
        panel.curves.push_back(std::move(marks));
    }
    if (!heavy.points.empty())
        panel.curves.push_back(std::move(heavy));
    panel.y.low = 0.4;
    panel.y.high = row + 0.9;
    panel.height *= static_cast<int>(row) + 1;
    return {"Critical speeds: " + title_of(scene), "synchronous whirl, 1×", {panel}};
}

/// What the margins come to, and why some are not enough.
Sentence verdict_of(const std::vector<SeparationMargin> &margins) {
    if (margins.empty())
        return Sentence("none needs a separation margin");
    Sentence out;
    const auto add = [&](const char *one, const char *several, const auto &is_why) {
        const auto count = std::ranges::count_if(
            margins, [&](const SeparationMargin &m) { return !m.passes && is_why(m); });
        if (count > 0)
            out += Sentence("{}{} of {}{} {}", out.empty() ? "" : ", ", count, margins.size(),
                            out.empty() ? " separation margins" : "", count == 1 ? one : several);
    };
    const auto near = [](const SeparationMargin &m) {
        return !m.required || m.found < *m.required;
    };
    add("is too small", "are too small",
        [&](const SeparationMargin &m) { return !m.grows && near(m); });
    add("is at a speed reached before the trip", "are at speeds reached before the trip",
        [&](const SeparationMargin &m) { return !m.grows && !near(m); });
    add("is of a motion that grows", "are of motions that grow",
        [](const SeparationMargin &m) { return m.grows; });
    return out.empty() ? Sentence("each has the separation margin that it must have") : out;
}

/// The critical speeds and what their margins come to, in one sentence.
Sentence answer_of(const CriticalResult &result) {
    namespace as = model::as;
    constexpr std::size_t most = 8; // in a sentence
    std::vector<double> sharp;
    for (const CriticalSpeed &critical : result.critical_speeds)
        if (!critical.damping.heavy())
            sharp.push_back(critical.speed);
    const std::size_t all = sharp.size();
    sharp.resize(std::min(all, most));
    Sentence answer = all == 0      ? Sentence("no critical speed that is not heavily damped")
                      : all <= most ? Sentence("critical speeds at {}", as::speed.list(sharp, 5))
                                    : Sentence("critical speeds at {} and {} more",
                                               as::speed.list(sharp, 5), all - most);
    if (!result.margins)
        return answer;
    return answer += Sentence("; {}", verdict_of(*result.margins));
}

std::vector<Section> brief_of(const CriticalResult &result, const Units &units) {
    std::vector<Section> sections;
    if (result.margins)
        sections.push_back({margins_heading, margins_page(*result.margins, units)});
    add_table(sections, "Critical speeds", critical_columns, result.critical_speeds, units,
              brief_rows);
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
                    add_sections(sections, critical_map_sections(scene, *result.map, units));
                return sections;
            },
        .text = [&](const Units &units) { return text_of(scene, result, units); },
        .chart = [&](const Units &units) { return critical_chart(scene, result, units); }};
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
