// Report of the command stability.

#include "results/stability.h"

#include "report/common/csv.h"
#include "report/common/table.h"
#include "report/common/words.h"
#include "report/pictures/figures.h"
#include "report/reports.h"
#include "report/stability/bands.h"

#include <fmt/format.h>

#include <algorithm>

namespace whirl::report {

using results::Level1;
using results::PermissibleAnisotropy;
using results::StabilityResult;
using results::Verdict;

namespace {

/// Without the columns in which no row has anything.
template <class Row, class Rows>
[[nodiscard]] Columns<Row> without_empty(Columns<Row> columns, const Rows &rows) {
    std::erase_if(columns, [&rows](const Column<Row> &column) {
        for (std::size_t index = 0; const Row &row : rows)
            if (!column.value(row, index++).is_null())
                return false;
        return true;
    });
    return columns;
}

/// Ends of growth, and the lines of the file that they are.
const Columns<results::StabilityEnd> end_columns{
    {"speed", InCsv("from"), OnPage("Speed (rad/s)", "{:.10g}"), InText("speed rad/s", precise),
     &results::StabilityEnd::speed},
    {InCsv("to"), &results::StabilityEnd::speed},
    {InCsv("kind"), [](const auto &) { return "end"; }},
    {OnPage("Speed (rpm)", "{:.8g}"), InText("speed rpm"), in(rpm, &results::StabilityEnd::speed)},
    {"mode", InCsv("mode"), OnPage("Mode", "{}", ""), InText("mode", "{}", ""),
     [](const auto &end) { return known_name(end.mode); }},
    {"kind", InCsv("verdict"), OnPage("What happens"), InText("kind"),
     [](const auto &end) { return results::end_kind_name(end.kind); }},
    {"growing_below", InCsv("growing below"), ForReaders("growing below"),
     &results::StabilityEnd::growing_below},
    {"growing_above", InCsv("growing above"), ForReaders("growing above"),
     &results::StabilityEnd::growing_above},
    {"frequency_rotating", InCsv("frequency in rotating axes [rad/s]"),
     OnPage("frequency in rotating axes (rad/s)", "{:.8g}"),
     InText("in rotating axes rad/s", "{:#.8g}"), &results::StabilityEnd::frequency_rotating},
    {"frequency", InCsv("frequency in fixed axes [rad/s]"),
     OnPage("in fixed axes (rad/s)", "{:.8g}"), InText("in fixed axes rad/s", "{:#.8g}"),
     &results::StabilityEnd::frequency},
    {"error", [](const auto &end) { return end.resolved.error; }}};

const Columns<PermissibleAnisotropy> permissible_columns{
    {"name", OnPage("Element"), &PermissibleAnisotropy::name},
    {"z", OnPage("z (m)", "{:.5g}"), &PermissibleAnisotropy::z},
    {InText("anisotropy at"), place_of},
    {"dI", &PermissibleAnisotropy::dI},
    {OnPage("largest dI (kg m²)", "{:.8g}"),
     [](const auto &entry) {
         return entry.dI ? Json(*entry.dI) : Json("stable up to the most there can be");
     }},
    {InText("largest dI kg m2", precise),
     [](const auto &entry) { return entry.dI ? Json(*entry.dI) : Json("stable up to the most"); }},
    {"most", OnPage("most there can be (kg m²)", "{:.8g}"), InText("most there can be", precise),
     &PermissibleAnisotropy::most},
    {"closed_form", OnPage("rigid closed form (kg m²)", "{:.8g}"),
     InText("rigid closed form", precise), &PermissibleAnisotropy::closed_form},
    {"of_disc", &PermissibleAnisotropy::of_disc}};

// Level-I stability.

/// Q0 over the coupling that is anticipated.
std::optional<double> reserve(const Level1 &level1) {
    return level1.anticipated && level1.critical_cross_coupling
               ? std::optional(*level1.critical_cross_coupling / *level1.anticipated)
               : std::nullopt;
}

std::optional<double> without_coupling(const Level1 &level1) {
    return level1.log_dec.empty() ? std::nullopt : std::optional(level1.log_dec.front());
}

const Columns<Level1> level1_columns{
    {"z", OnPage("z (m)", "{:.6g}"), InText("added at z (m)"), &Level1::z},
    {"speed", &Level1::speed},
    {OnPage("Spin speed (rpm)", "{:.6g}"), InText("spin speed (rpm)", "{:.6g}"),
     in(rpm, &Level1::speed)},
    {OnPage("Logarithmic decrement without it", "{:.6g}"),
     InText("log. decrement without it", "{:.6g}"), without_coupling},
    {"critical_cross_coupling", OnPage("Critical cross coupling (N/m)", "{:.10g}"),
     InText("critical cross coupling (N/m)", precise), &Level1::critical_cross_coupling},
    {"error", OnPage("Relative error", "{:.2g}"), InText("its relative error", rough),
     &Level1::error},
    {"critical_frequency", &Level1::critical_frequency},
    {OnPage("Frequency there (Hz)", "{:.6g}"), InText("frequency there (Hz)", "{:.6g}"),
     in(hertz, &Level1::critical_frequency)},
    {"anticipated", OnPage("Anticipated cross coupling (N/m)", "{:.6g}"),
     InText("anticipated cross coupling (N/m)", "{:.6g}"), &Level1::anticipated},
    {"anticipated_log_dec", OnPage("Logarithmic decrement with that", "{:.6g}"),
     InText("log. decrement with that", "{:.6g}"), &Level1::anticipated_log_dec},
    {"ratio", OnPage("Critical over anticipated", "{:.4g}"),
     InText("critical over anticipated", "{:.4g}"), reserve},
    {"q", &Level1::q},
    {"log_dec", &Level1::log_dec},
    {"frequency", &Level1::frequency}};

Picture level1_picture(const model::Case &scene, const Level1 &level1, const Units &units) {
    return {"level1", level1_figure(scene, level1, units), [&level1](const Units &) {
                return csv_lists({{"q [N/m]", level1.q},
                                  {"log_dec", level1.log_dec},
                                  {"frequency [rad/s]", level1.frequency}});
            }};
}

Json family_json(const results::ArrangementFamily &family) {
    return {{"arrangements", family.arrangements},
            {"unstable", family.unstable},
            {"always_unstable", family.always_unstable},
            {"critical_speeds", family.critical_speeds},
            {"additional_speeds", family.additional_speeds},
            {"anisotropy", family.anisotropy}};
}

Json map_json(const results::StabilityMap &map) {
    return {{"x", {{"path", map.x.path}, {"values", map.x_values}}},
            {"y", {{"path", map.y.path}, {"values", map.y_values}}},
            {"growth", map.growth}};
}

Json json_verdicts(const std::vector<Verdict> &verdicts) {
    return json_list(verdicts, [](Verdict verdict) {
        const std::string name = results::verdict_name(verdict);
        return name.empty() ? Json() : Json(name);
    });
}

Json json_of(const StabilityResult &result, const Units &) {
    return {{"speeds", result.speeds},
            {"growth", result.growth},
            {"verdict", json_verdicts(result.verdict)},
            {"unstable", result.unstable},
            {"unstable_error", result.unstable_error},
            {"ends", json_rows(end_columns, result.ends)},
            {"resolved_up_to", result.resolved_up_to},
            {"unresolved_ends", json_rows(end_columns, result.unresolved_ends)},
            {"resolved_growth", result.resolved_growth},
            {"resolved_verdict", json_verdicts(result.resolved_verdict)},
            {"resolved_unstable", result.resolved_unstable},
            {"resolved_unstable_error", result.resolved_unstable_error},
            {"unresolved_growth", result.unresolved_growth},
            {"critical_speeds", result.critical_speeds},
            {"zero_root_speeds", result.zero_root_speeds},
            {"additional_speeds", result.additional_speeds},
            {"permissible", json_rows(permissible_columns, result.permissible)},
            {"neutral_pairs", result.neutral_pairs},
            {"harmonics", result.harmonics},
            {"family", result.family ? family_json(*result.family) : Json()},
            {"map", result.map ? map_json(*result.map) : Json()},
            {"level1", result.level1 ? json_row(level1_columns, *result.level1) : Json()}};
}

std::string csv_of(const StabilityResult &result, const Units &) {
    const Columns<BandLine> all = file_columns(result);
    std::vector<std::string> head = csv_head(all);
    for (const std::string &heading : csv_head(end_columns))
        if (std::find(head.begin(), head.end(), heading) == head.end())
            head.push_back(heading);
    const auto rows = [&](const std::vector<BandLine> &of) { return csv_rows(head, all, of); };
    std::string csv = csv_head_line(head) + rows(growth_lines(result)) +
                      rows(band_lines("unstable", result.unstable, &result.unstable_error)) +
                      rows(band_lines("unstable, resolved", result.resolved_unstable,
                                      &result.resolved_unstable_error)) +
                      csv_rows(head, end_columns, result.ends) +
                      rows(speed_lines("critical speed", result.critical_speeds)) +
                      rows(speed_lines("zero root", result.zero_root_speeds)) +
                      rows(speed_lines("additional speed", result.additional_speeds));
    if (const auto &family = result.family)
        csv += rows(band_lines("unstable with some arrangement", family->unstable)) +
               rows(band_lines("unstable with every arrangement", family->always_unstable)) +
               rows(band_lines("critical speed over arrangements", family->critical_speeds)) +
               rows(band_lines("additional speed over arrangements", family->additional_speeds));
    return result.map ? csv + rows(map_lines(*result.map)) : csv;
}

/// Speeds at which something stands still in rotating axes.
std::vector<BandLine> still_speeds(const StabilityResult &result) {
    std::vector<BandLine> all =
        speed_lines("critical, balls held, undamped", result.critical_speeds);
    for (const auto &more :
         {speed_lines("a root is zero: a motion stands still and neither grows nor dies out",
                      result.zero_root_speeds),
          speed_lines("additional: pinned at the balancers", result.additional_speeds)})
        all.insert(all.end(), more.begin(), more.end());
    return all;
}

const Columns<BandLine> still_columns{{OnPage("Kind"), &BandLine::kind},
                                      {OnPage("rad/s", "{:.10g}"), &BandLine::from},
                                      {OnPage("rpm", "{:.8g}"), in(rpm, &BandLine::from)}};

std::vector<Section> sections_of(const StabilityResult &result, const Units &) {
    std::vector<Section> sections = headline_sections(result);
    if (!result.ends.empty())
        sections.push_back({"Speeds at which the number of growing motions changes",
                            page_table(without_empty(end_columns, result.ends), result.ends)});
    if (!result.unresolved_ends.empty())
        sections.push_back({"The same of motions that the elements do not resolve",
                            page_table(without_empty(end_columns, result.unresolved_ends),
                                       result.unresolved_ends)});
    if (const std::vector<BandLine> still = still_speeds(result); !still.empty())
        sections.push_back({"Speeds at which something stands still in rotating axes",
                            page_table(still_columns, still)});
    if (!result.permissible.empty())
        sections.push_back({"Permissible inertial anisotropy",
                            page_table(permissible_columns, result.permissible)});
    if (result.level1)
        sections.push_back({"Level-I stability: added cross coupling",
                            page_properties(level1_columns, *result.level1)});
    if (!result.family)
        return sections;
    const results::ArrangementFamily &family = *result.family;
    const std::string some =
        fmt::format("Unstable with some of {} arrangements of the balls", family.arrangements);
    for (const auto &[title, bands] :
         {std::pair(some, &family.unstable),
          std::pair(std::string("Unstable with every one of them"), &family.always_unstable),
          std::pair(std::string("Critical speeds over the arrangements"), &family.critical_speeds),
          std::pair(std::string("Additional speeds over the arrangements"),
                    &family.additional_speeds)})
        sections.push_back({title, bands_section(*bands)});
    return sections;
}

std::string speeds_text(const std::string &title, const std::vector<double> &speeds) {
    std::string text = title + ":";
    for (const double speed : speeds)
        text += fmt::format(" {:#.10g}", speed);
    return speeds.empty() ? "" : text + " rad/s\n";
}

std::string text_of(const model::Case &scene, const StabilityResult &result, const Units &) {
    std::string text = heading(scene, "Stability, " + range_text(result.speeds));
    text += headline_text(result) +
            text_table("Speeds at which the number of growing motions changes:\n",
                       without_empty(end_columns, result.ends), result.ends);
    if (!result.unresolved_ends.empty())
        text += fmt::format("Not resolved by the elements: {} more {}, of motions with frequencies "
                            "above {:.6g} rad/s\n",
                            result.unresolved_ends.size(),
                            result.unresolved_ends.size() == 1 ? "end" : "ends",
                            *result.resolved_up_to);
    text +=
        speeds_text("Critical speeds, balls held, undamped", result.critical_speeds) +
        speeds_text("A root is zero at", result.zero_root_speeds) +
        speeds_text("Additional speeds (rotor pinned at the balancers)", result.additional_speeds);
    if (const auto &family = result.family)
        text += "\n" +
                bands_text(fmt::format("Unstable with some of {} arrangements of the balls",
                                       family->arrangements),
                           family->unstable) +
                bands_text("Unstable with every arrangement", family->always_unstable) +
                bands_text("Critical speeds over the arrangements", family->critical_speeds);
    text += text_table("\nPermissible inertial anisotropy over this range:\n", permissible_columns,
                       result.permissible);
    if (result.level1)
        text += "\nLevel-I stability, added cross coupling:\n" +
                text_table(properties(level1_columns, *result.level1, &Column<Level1>::text, "-"));
    return text + model_text(result.model);
}

} // namespace

Report describe(const model::Case &scene, const StabilityResult &result) {
    Report report =
        report_of<StabilityResult>("stability", "Stability", scene, result,
                                   {json_of, csv_of, sections_of, text_of, stability_figure});
    if (result.level1) {
        report.pictures = [&](const Units &units) {
            return std::vector{level1_picture(scene, *result.level1, units)};
        };
        report.pictures_heading = "Logarithmic decrement over added cross coupling";
        report.pictures_after = sections_of(result, {}).size();
    }
    return report;
}

} // namespace whirl::report
