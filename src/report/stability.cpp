// Report of the command stability.

#include "results/stability.h"

#include "report/common/csv.h"
#include "report/common/table.h"
#include "report/common/words.h"
#include "report/level1.h"
#include "report/pictures/figures.h"
#include "report/reports.h"

#include <fmt/format.h>

#include <algorithm>

namespace whirl::report {

using results::PermissibleAnisotropy;
using results::StabilityResult;
using results::Verdict;

namespace {

using Pairs = std::vector<std::pair<double, double>>;

/// A line of the file. Of a band from and to are its ends; of a map they are its two entries.
struct BandLine {
    std::string kind;
    double from = 0, to = 0;
    std::optional<double> growth{};
    std::string verdict{};
    std::optional<std::pair<double, double>> errors{};
};

template <class Pair> auto first(std::optional<Pair> BandLine::*of) {
    return [of](const BandLine &line) { return line.*of ? Json((line.*of)->first) : Json(); };
}
template <class Pair> auto second(std::optional<Pair> BandLine::*of) {
    return [of](const BandLine &line) { return line.*of ? Json((line.*of)->second) : Json(); };
}
double width(const BandLine &line) { return line.to - line.from; }

/// Lines of the file, and of the tables of bands.
const Columns<BandLine> band_line_columns{
    {"", "kind", {}, {}, &BandLine::kind},
    {"", "from", {"From (rad/s)", "{:.10g}"}, {"from rad/s", precise}, &BandLine::from},
    {"", "to", {"to (rad/s)", "{:.10g}"}, {"to rad/s", precise}, &BandLine::to},
    {"",
     "",
     {"from (rpm)", "{:.8g}"},
     {"from rpm"},
     [](const BandLine &line) { return line.from * rpm; }},
    {"",
     "",
     {"to (rpm)", "{:.8g}"},
     {"to rpm"},
     [](const BandLine &line) { return line.to * rpm; }},
    {"", "", {"width (rad/s)", "{:.4g}"}, {"width rad/s"}, width},
    {"", "growth [1/s]", {}, {}, &BandLine::growth},
    {"", "verdict", {}, {}, &BandLine::verdict}};

/// The same with the errors of both ends.
Columns<BandLine> with_errors() {
    Columns<BandLine> more = band_line_columns;
    more.push_back({"",
                    "error of from",
                    {"error of from (rad/s)", "{:.2g}"},
                    {"error of from", rough},
                    first(&BandLine::errors)});
    more.push_back({"",
                    "error of to",
                    {"error of to (rad/s)", "{:.2g}"},
                    {"error of to", rough},
                    second(&BandLine::errors)});
    return more;
}

std::vector<BandLine> lines(const std::string &kind, const Pairs &bands, const Pairs &errors = {}) {
    std::vector<BandLine> all;
    for (std::size_t i = 0; i < bands.size(); ++i) {
        all.push_back({kind, bands[i].first, bands[i].second});
        if (i < errors.size())
            all.back().errors = errors[i];
    }
    return all;
}

std::vector<BandLine> lines(const std::string &kind, const std::vector<double> &speeds) {
    std::vector<BandLine> all;
    for (const double speed : speeds)
        all.push_back({kind, speed, speed});
    return all;
}

std::vector<BandLine> growth_lines(const StabilityResult &result) {
    std::vector<BandLine> all;
    for (std::size_t i = 0; i < result.speeds.size() && i < result.growth.size(); ++i)
        all.push_back({"growth", result.speeds[i], result.speeds[i], result.growth[i],
                       i < result.verdict.size() ? results::verdict_name(result.verdict[i]) : ""});
    return all;
}

std::vector<BandLine> map_lines(const results::StabilityMap &map) {
    std::vector<BandLine> all;
    for (std::size_t j = 0; j < map.growth.size(); ++j)
        for (std::size_t i = 0; i < map.growth[j].size(); ++i)
            all.push_back({"map", map.x_values[i], map.y_values[j], map.growth[j][i]});
    return all;
}

/// Ends of growth, and the lines of the file that they are.
const Columns<results::StabilityEnd> end_columns{
    {"speed",
     "from",
     {"Speed (rad/s)", "{:.10g}"},
     {"speed rad/s", precise},
     &results::StabilityEnd::speed},
    {"", "to", {}, {}, &results::StabilityEnd::speed},
    {"", "kind", {}, {}, [](const auto &) { return "end"; }},
    {"",
     "",
     {"Speed (rpm)", "{:.8g}"},
     {"speed rpm"},
     [](const auto &end) { return end.speed * rpm; }},
    {"mode",
     "mode",
     {"Mode", "{}", ""},
     {"mode", "{}", ""},
     [](const auto &end) { return known_name(end.mode); }},
    {"kind",
     "verdict",
     {"What happens"},
     {"kind"},
     [](const auto &end) { return results::end_kind_name(end.kind); }},
    {"growing_below",
     "growing below",
     {"growing below"},
     {"growing below"},
     &results::StabilityEnd::growing_below},
    {"growing_above",
     "growing above",
     {"growing above"},
     {"growing above"},
     &results::StabilityEnd::growing_above},
    {"frequency_rotating",
     "frequency in rotating axes [rad/s]",
     {"frequency in rotating axes (rad/s)", "{:.8g}"},
     {"in rotating axes rad/s", "{:#.8g}"},
     &results::StabilityEnd::frequency_rotating},
    {"frequency",
     "frequency in fixed axes [rad/s]",
     {"in fixed axes (rad/s)", "{:.8g}"},
     {"in fixed axes rad/s", "{:#.8g}"},
     &results::StabilityEnd::frequency},
    {"error", "", {}, {}, [](const auto &end) {
         return end.resolved.error ? Json(*end.resolved.error) : Json();
     }}};

const Columns<PermissibleAnisotropy> permissible_columns{
    {"name", "", {"Element"}, {}, &PermissibleAnisotropy::name},
    {"z", "", {"z (m)", "{:.5g}"}, {}, &PermissibleAnisotropy::z},
    {"", "", {}, {"anisotropy at"}, [](const auto &entry) { return place(entry.name, entry.z); }},
    {"dI", "", {}, {}, &PermissibleAnisotropy::dI},
    {"",
     "",
     {"largest dI (kg m²)", "{:.8g}"},
     {},
     [](const auto &entry) {
         return entry.dI ? Json(*entry.dI) : Json("stable up to the most there can be");
     }},
    {"",
     "",
     {},
     {"largest dI kg m2", precise},
     [](const auto &entry) { return entry.dI ? Json(*entry.dI) : Json("stable up to the most"); }},
    {"most",
     "",
     {"most there can be (kg m²)", "{:.8g}"},
     {"most there can be", precise},
     &PermissibleAnisotropy::most},
    {"closed_form",
     "",
     {"rigid closed form (kg m²)", "{:.8g}"},
     {"rigid closed form", precise},
     &PermissibleAnisotropy::closed_form},
    {"of_disc", "", {}, {}, &PermissibleAnisotropy::of_disc}};

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

Json json_of(const StabilityResult &result) {
    return {{"speeds", result.speeds},
            {"growth", result.growth},
            {"verdict", json_list(result.verdict,
                                  [](Verdict verdict) {
                                      const std::string name = results::verdict_name(verdict);
                                      return name.empty() ? Json() : Json(name);
                                  })},
            {"unstable", result.unstable},
            {"unstable_error", result.unstable_error},
            {"ends", json_rows(end_columns, result.ends)},
            {"resolved_up_to", result.resolved_up_to ? Json(*result.resolved_up_to) : Json()},
            {"unresolved_ends", json_rows(end_columns, result.unresolved_ends)},
            {"resolved_growth", result.resolved_growth},
            {"critical_speeds", result.critical_speeds},
            {"zero_root_speeds", result.zero_root_speeds},
            {"additional_speeds", result.additional_speeds},
            {"permissible", json_rows(permissible_columns, result.permissible)},
            {"neutral_pairs", result.neutral_pairs},
            {"harmonics", result.harmonics},
            {"family", result.family ? family_json(*result.family) : Json()},
            {"map", result.map ? map_json(*result.map) : Json()},
            {"level1", result.level1 ? level1_json(*result.level1) : Json()}};
}

std::string csv_of(const StabilityResult &result) {
    const Columns<BandLine> all = with_errors();
    std::vector<std::string> head = csv_head(all);
    for (const std::string &heading : csv_head(end_columns))
        if (std::find(head.begin(), head.end(), heading) == head.end())
            head.push_back(heading);
    const auto rows = [&](const std::vector<BandLine> &of) { return csv_rows(head, all, of); };
    std::string csv = csv_line(head) + rows(growth_lines(result)) +
                      rows(lines("unstable", result.unstable, result.unstable_error)) +
                      csv_rows(head, end_columns, result.ends) +
                      rows(lines("critical speed", result.critical_speeds)) +
                      rows(lines("zero root", result.zero_root_speeds)) +
                      rows(lines("additional speed", result.additional_speeds));
    if (const auto &family = result.family)
        csv += rows(lines("unstable with some arrangement", family->unstable)) +
               rows(lines("unstable with every arrangement", family->always_unstable)) +
               rows(lines("critical speed over arrangements", family->critical_speeds)) +
               rows(lines("additional speed over arrangements", family->additional_speeds));
    return result.map ? csv + rows(map_lines(*result.map)) : csv;
}

std::string bands_section(const std::vector<BandLine> &bands,
                          const Columns<BandLine> &shown_columns) {
    return bands.empty() ? "<p>None in this range.</p>\n" : page_table(shown_columns, bands);
}

/// Of one speed: what becomes of a small motion there.
std::string verdict_section(const StabilityResult &result) {
    const std::string name = results::verdict_name(result.verdict.front());
    if (name.empty())
        return "<p>No answer at this speed.</p>\n";
    return fmt::format("<p>{} at {:.5g} rad/s: largest growth {:.8g} 1/s.</p>\n", name,
                       result.speeds.front(), result.growth.front());
}

/// Speeds at which something stands still in rotating axes.
std::vector<BandLine> still_speeds(const StabilityResult &result) {
    std::vector<BandLine> all = lines("critical, balls held, undamped", result.critical_speeds);
    for (const auto &more :
         {lines("a root is zero: a motion stands still and neither grows nor dies out",
                result.zero_root_speeds),
          lines("additional: pinned at the balancers", result.additional_speeds)})
        all.insert(all.end(), more.begin(), more.end());
    return all;
}

const Columns<BandLine> still_columns{
    {"", "", {"Kind"}, {}, &BandLine::kind},
    {"", "", {"rad/s", "{:.10g}"}, {}, &BandLine::from},
    {"", "", {"rpm", "{:.8g}"}, {}, [](const BandLine &line) { return line.from * rpm; }}};

std::vector<Section> sections_of(const StabilityResult &result) {
    std::vector<Section> sections;
    if (result.speeds.size() == 1)
        sections.push_back({"Stability at this speed", verdict_section(result)});
    else
        sections.push_back(
            {"Unstable spin speeds",
             bands_section(lines("", result.unstable, result.unstable_error), with_errors())});
    if (!result.ends.empty())
        sections.push_back({"Speeds at which the number of growing motions changes",
                            page_table(end_columns, result.ends)});
    if (!result.unresolved_ends.empty())
        sections.push_back({"The same of motions that the elements do not resolve",
                            page_table(end_columns, result.unresolved_ends)});
    if (const std::vector<BandLine> still = still_speeds(result); !still.empty())
        sections.push_back({"Speeds at which something stands still in rotating axes",
                            page_table(still_columns, still)});
    if (!result.permissible.empty())
        sections.push_back({"Permissible inertial anisotropy",
                            page_table(permissible_columns, result.permissible)});
    if (result.level1)
        sections.push_back(level1_section(*result.level1));
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
        sections.push_back({title, bands_section(lines("", *bands), band_line_columns)});
    return sections;
}

std::string verdict_text(const StabilityResult &result) {
    const double growth = result.growth.front();
    switch (result.verdict.front()) {
    case Verdict::stable:
        return fmt::format("Stable: every motion dies out, the slowest with {:.6g} 1/s\n", growth);
    case Verdict::neutral:
        return "Neither stable nor unstable: no motion grows, some do not die out either (no "
               "damping)\n";
    case Verdict::unstable:
        return fmt::format("Unstable: a whirl grows with {:.6g} 1/s\n", growth);
    case Verdict::diverges:
        return fmt::format("Unstable: it diverges, a real root of +{:.6g} 1/s\n", growth);
    default:
        return "No answer at this speed\n";
    }
}

std::string bands_text(const std::string &title, const std::vector<BandLine> &bands,
                       const Columns<BandLine> &shown_columns) {
    return bands.empty() ? title + ": none in this range\n"
                         : title + ":\n" + text_table(shown_columns, bands);
}

std::string speeds_text(const std::string &title, const std::vector<double> &speeds) {
    std::string text = title + ":";
    for (const double speed : speeds)
        text += fmt::format(" {:#.10g}", speed);
    return speeds.empty() ? "" : text + " rad/s\n";
}

std::string text_of(const model::Case &scene, const StabilityResult &result) {
    std::string text = heading(scene, "Stability, " + range_text(result.speeds));
    text += result.speeds.size() == 1
                ? verdict_text(result)
                : bands_text("Unstable", lines("", result.unstable, result.unstable_error),
                             with_errors());
    if (!result.ends.empty())
        text += "Speeds at which the number of growing motions changes:\n" +
                text_table(end_columns, result.ends);
    if (!result.unresolved_ends.empty())
        text += fmt::format("Not resolved by the elements: {} more ends, of motions faster than "
                            "{:.6g} rad/s\n",
                            result.unresolved_ends.size(), *result.resolved_up_to);
    text +=
        speeds_text("Critical speeds, balls held, undamped", result.critical_speeds) +
        speeds_text("A root is zero at", result.zero_root_speeds) +
        speeds_text("Additional speeds (rotor pinned at the balancers)", result.additional_speeds);
    if (const auto &family = result.family)
        text += "\n" +
                bands_text(fmt::format("Unstable with some of {} arrangements of the balls",
                                       family->arrangements),
                           lines("", family->unstable), band_line_columns) +
                bands_text("Unstable with every arrangement", lines("", family->always_unstable),
                           band_line_columns) +
                bands_text("Critical speeds over the arrangements",
                           lines("", family->critical_speeds), band_line_columns);
    if (!result.permissible.empty())
        text += "\nPermissible inertial anisotropy over this range:\n" +
                text_table(permissible_columns, result.permissible);
    if (result.level1)
        text += level1_text(*result.level1);
    return text + model_text(result.model);
}

} // namespace

Report describe(const model::Case &scene, const StabilityResult &result) {
    Report report =
        report_of<StabilityResult>("stability", "Stability", scene, result,
                                   {json_of, csv_of, sections_of, text_of, stability_figure});
    if (result.level1) {
        report.pictures = [&] { return std::vector{level1_picture(scene, *result.level1)}; };
        report.pictures_heading = "Logarithmic decrement over added cross coupling";
        report.pictures_after = sections_of(result).size();
    }
    return report;
}

} // namespace whirl::report
