// Report of the command stability.

#include "results/stability.h"

#include "report/common/csv.h"
#include "report/common/html.h"
#include "report/common/text_width.h"
#include "report/common/words.h"
#include "report/pictures/figures.h"
#include "report/reports.h"
#include "report/sections.h"
#include "report/stability/bands.h"
#include "report/steady_states.h"

#include <fmt/format.h>

#include <algorithm>

namespace whirl::report {

using results::Level1;
using results::Level1Judged;
using results::PermissibleAnisotropy;
using results::StabilityResult;
using results::Verdict;

namespace {

/// Without the columns in which no row has anything.
template <class Row, class Rows>
[[nodiscard]] Columns<Row> without_empty(Columns<Row> columns, const Rows &rows) {
    std::erase_if(columns, [&rows](const Column<Row> &column) {
        for (std::size_t index = 0; const Row &row : rows)
            if (!column.value(row, index++, {}).is_null())
                return false;
        return true;
    });
    return columns;
}

/// Ends of growth, and the lines of the file that they are.
const Columns<results::StabilityEnd> end_columns{
    {"speed", InCsv("from"), OnPage("Speed", "{:.8g}").and_si("{:.10g}"),
     InText("speed").and_si(precise), Quantity::speed, &results::StabilityEnd::speed},
    {InCsv("to"), Quantity::speed, &results::StabilityEnd::speed},
    {InCsv("kind"), [](const auto &) { return "end"; }},
    {InFiles("mode"), Titled("Mode", "{}", ""),
     [](const auto &end) { return known_name(end.mode); }},
    {"kind", InCsv("verdict"), OnPage("What happens"), InText("kind"),
     [](const auto &end) { return results::end_kind_name(end.kind); }},
    {"growing_below", InCsv("growing below"), ForReaders("growing below"),
     &results::StabilityEnd::growing_below},
    {"growing_above", InCsv("growing above"), ForReaders("growing above"),
     &results::StabilityEnd::growing_above},
    {"frequency_rotating", InCsv("frequency in rotating axes"),
     OnPage("frequency in rotating axes", "{:.8g}"), InText("in rotating axes", "{:#.8g}"),
     Quantity::frequency, &results::StabilityEnd::frequency_rotating},
    {"frequency", InCsv("frequency in fixed axes"), OnPage("in fixed axes", "{:.8g}"),
     InText("in fixed axes", "{:#.8g}"), Quantity::frequency, &results::StabilityEnd::frequency},
    {"error", Quantity::speed, [](const auto &end) { return end.resolved.error; }}};

const Columns<PermissibleAnisotropy> permissible_columns{
    {"name", OnPage("Element"), &PermissibleAnisotropy::name},
    {"z", OnPage("z", "{:.5g}"), Quantity::length, &PermissibleAnisotropy::z},
    {InText("anisotropy at"), place_of},
    {"dI", Quantity::inertia, &PermissibleAnisotropy::dI},
    {OnPage("largest dI", "{:.8g}"), Quantity::inertia,
     [](const auto &entry) {
         return entry.dI ? Json(*entry.dI) : Json("stable up to the most there can be");
     }},
    {InText("largest dI", precise), Quantity::inertia,
     [](const auto &entry) { return entry.dI ? Json(*entry.dI) : Json("stable up to the most"); }},
    {"most", OnPage("most there can be", "{:.8g}"), InText("most there can be", precise),
     Quantity::inertia, &PermissibleAnisotropy::most},
    {"closed_form", OnPage("rigid closed form", "{:.8g}"), InText("rigid closed form", precise),
     Quantity::inertia, &PermissibleAnisotropy::closed_form},
    {"of_disc", &PermissibleAnisotropy::of_disc}};

// Level-I stability.

/// Q0 over the coupling that is anticipated.
std::optional<double> reserve(const Level1 &level1) {
    return level1.anticipated && level1.critical_cross_coupling
               ? std::optional(*level1.critical_cross_coupling / *level1.anticipated)
               : std::nullopt;
}

std::optional<std::string> known_text(const results::Sentence &sentence, const Units &units) {
    return known_name(units.text(sentence));
}

std::optional<double> without_coupling(const Level1 &level1) {
    return level1.log_dec.empty() ? std::nullopt : std::optional(level1.log_dec.front());
}

/// Of what the checks judge, where that is another motion.
template <auto Member> std::optional<double> judged(const Level1 &level1) {
    return level1.judged ? (*level1.judged).*Member : std::nullopt;
}

const Columns<Level1> level1_columns{
    {"z", OnPage("z"), InText("added at z"), Quantity::length, &Level1::z},
    {"speed", Titled("Spin speed"), Quantity::speed, &Level1::speed},
    {OnPage("Logarithmic decrement without it"), InText("log. decrement without it"),
     Quantity::number, without_coupling},
    {"critical_cross_coupling", OnPage("Critical cross coupling", "{:.10g}"),
     InText("critical cross coupling", precise), Quantity::stiffness,
     &Level1::critical_cross_coupling},
    {"error", OnPage("Relative error", "{:.2g}"), InText("its relative error", rough),
     Quantity::number, &Level1::error},
    {"no_critical", Titled("Why there is none"),
     [](const auto &level1, const Units &units) { return known_text(level1.no_critical, units); }},
    {"critical_frequency", Titled("Frequency there"), Quantity::frequency,
     &Level1::critical_frequency},
    {"anticipated", Titled("Anticipated cross coupling"), Quantity::stiffness,
     &Level1::anticipated},
    {"anticipated_log_dec", OnPage("Logarithmic decrement with that"),
     InText("log. decrement with that"), Quantity::number, &Level1::anticipated_log_dec},
    {"ratio", Titled("Critical over anticipated", "{:.4g}"), Quantity::number, reserve},
    {OnPage("Of the first slower motion: critical cross coupling", "{:.10g}"),
     InText("of a slower motion", precise), Quantity::stiffness,
     judged<&Level1Judged::critical_cross_coupling>},
    {Titled("Its frequency there"), Quantity::frequency, judged<&Level1Judged::critical_frequency>},
    {OnPage("Its logarithmic decrement with the anticipated one"), InText("its log. decrement"),
     Quantity::number, judged<&Level1Judged::anticipated_log_dec>},
    {"gas_density", Titled("Gas density"), Quantity::density, &Level1::gas_density},
    {"critical_speed_ratio", Titled("Critical speed ratio", "{:.4g}"), Quantity::number,
     &Level1::critical_speed_ratio},
    {"level_two", &Level1::level_two},
    {"verdict", [](const auto &level1, const Units &units) { return units.text(level1.verdict); }},
    {"q", Quantity::stiffness, &Level1::q},
    {"log_dec", Quantity::number, &Level1::log_dec},
    {"frequency", Quantity::frequency, &Level1::frequency}};

// The same with other clearances of the bearings.

const Columns<StabilityResult> clearance_columns{
    {"clearance", ForReaders("clearance"),
     [](const StabilityResult &result) { return model::fit_name(result.fit); }},
    {"growth", Titled("Largest growth", "{:.5g}"), Quantity::rate, results::largest_growth},
    {Titled("Unstable"),
     [](const StabilityResult &result, const Units &units) {
         std::string text;
         for (const results::Interval &band : results::unstable_speeds(result))
             text +=
                 (text.empty() ? "" : ", ") +
                 units.text(model::Sentence("{}", model::as::speed.range(band.from, band.to, 5)));
         return text.empty() ? "nowhere" : text;
     }},
    {Titled("Critical cross coupling", "{:.5g}"), Quantity::stiffness,
     [](const StabilityResult &result) {
         return result.level1 ? result.level1->critical_cross_coupling : std::nullopt;
     }},
    {OnPage("Logarithmic decrement with that anticipated", "{:.4g}"),
     InText("log. decrement with that anticipated", "{:.4g}"), Quantity::number,
     [](const StabilityResult &result) {
         return result.level1 ? result.level1->anticipated_log_dec : std::nullopt;
     }},
    {Titled("Critical over anticipated", "{:.4g}"), Quantity::number,
     [](const StabilityResult &result) {
         return result.level1 ? reserve(*result.level1) : std::nullopt;
     }},
    {"unstable", Quantity::speed, results::unstable_speeds}};

/// The result as given first.
std::vector<StabilityResult> all_clearances(const StabilityResult &result) {
    std::vector<StabilityResult> all{result};
    all.insert(all.end(), result.clearances.begin(), result.clearances.end());
    return all;
}

std::string least_stable_in_words(const StabilityResult &result) {
    return "Least stable with clearance " + model::fit_name(results::least_stable(result).fit) +
           ".";
}

const Columns<results::Level1Stage> stage_columns{
    {"name", Titled("Stage"), &results::Level1Stage::name},
    {"kind", Titled("Kind"),
     [](const auto &stage) { return stage.axial ? "axial" : "centrifugal"; }},
    {"power", Titled("Power"), Quantity::power, &results::Level1Stage::power},
    {"speed", Titled("Spin speed"), Quantity::speed, &results::Level1Stage::speed},
    {"diameter", Titled("Diameter"), Quantity::length, &results::Level1Stage::diameter},
    {"width", Titled("Width"), Quantity::length, &results::Level1Stage::width},
    {"density_ratio", Titled("Density ratio"), Quantity::number,
     &results::Level1Stage::density_ratio},
    {"cross_coupling", Titled("Cross coupling"), Quantity::stiffness,
     &results::Level1Stage::cross_coupling}};

const char *passing(const results::Level1Check &check) {
    return !check.passes ? "not judged" : *check.passes ? "passes" : "fails";
}

const Columns<results::Level1Check> check_columns{
    {"name", OnPage("Level I (API 617)"), InText(""), &results::Level1Check::name},
    {"value", Titled("Value", "{:.4g}"), Quantity::number, &results::Level1Check::value},
    {"limit", Titled("At least", "{:.4g}"), Quantity::number, &results::Level1Check::limit},
    {"passes", &results::Level1Check::passes},
    {OnPage("Verdict"), InText(""), passing},
    {"why", Titled("Why"),
     [](const auto &check, const Units &units) { return known_text(check.why, units); }}};

const Columns<Level1Judged> judged_columns{
    {"critical_cross_coupling", Quantity::stiffness, &Level1Judged::critical_cross_coupling},
    {"critical_frequency", Quantity::frequency, &Level1Judged::critical_frequency},
    {"anticipated_log_dec", Quantity::number, &Level1Judged::anticipated_log_dec}};

Json level1_json(const Level1 &level1, const Units &units) {
    Json json = json_row(level1_columns, level1, units);
    json["judged"] = level1.judged ? json_row(judged_columns, *level1.judged, units) : Json();
    json["stages"] = json_rows(stage_columns, level1.stages, units);
    json["checks"] = json_rows(check_columns, level1.checks, units);
    return json;
}

std::vector<Section> level1_sections(const Level1 &level1, const Units &units) {
    std::vector<Section> sections{
        {"Level-I stability: added cross coupling",
         element("p", units.text(level1.verdict)) +
             (level1.checks.empty() ? "" : page_table(check_columns, level1.checks, units)) +
             page_properties(level1_columns, level1, units)}};
    add_table(sections, "Anticipated cross coupling of the stages", stage_columns, level1.stages,
              units);
    return sections;
}

std::string level1_text(const Level1 &level1, const Units &units) {
    return "\nLevel-I stability (API 617): " + printable(units.text(level1.verdict)) + "\n" +
           text_table("", without_empty(check_columns, level1.checks), level1.checks, units) +
           "added cross coupling:\n" +
           text_table(properties(without_empty(level1_columns, std::vector{level1}), level1,
                                 &Column<Level1>::text, "-", units)) +
           text_table("anticipated, of the stages:\n", without_empty(stage_columns, level1.stages),
                      level1.stages, units);
}

Picture level1_picture(const model::Case &scene, const Level1 &level1, const Units &units) {
    return {"level1", level1_chart(scene, level1, units), [&level1](const Units &files) {
                return csv_lists({{{"q", Quantity::stiffness}, level1.q},
                                  {{"log_dec"}, level1.log_dec},
                                  {{"frequency", Quantity::frequency}, level1.frequency}},
                                 files);
            }};
}

Json family_json(const results::ArrangementFamily &family, const Units &units) {
    return {{"arrangements", family.arrangements},
            {"unstable", written(units, Quantity::speed, family.unstable)},
            {"always_unstable", written(units, Quantity::speed, family.always_unstable)},
            {"critical_speeds", written(units, Quantity::speed, family.critical_speeds)},
            {"additional_speeds", written(units, Quantity::speed, family.additional_speeds)},
            {"anisotropy", written(units, Quantity::inertia, family.anisotropy)}};
}

Json map_json(const results::StabilityMap &map, const Units &units) {
    return {{"x", axis_json(map.x, map.x_changes, units)},
            {"y", axis_json(map.y, map.y_changes, units)},
            {"growth", written(units, Quantity::rate, map.growth)}};
}

Json json_verdicts(const std::vector<Verdict> &verdicts) {
    return json_list(verdicts, [](Verdict verdict) {
        const std::string name = results::verdict_name(verdict);
        return name.empty() ? Json() : Json(name);
    });
}

Json json_of(const StabilityResult &result, const Units &units) {
    const auto speeds = [&units](const auto &of) { return written(units, Quantity::speed, of); };
    const auto rates = [&units](const auto &of) { return written(units, Quantity::rate, of); };
    return {{"speeds", speeds(result.speeds)},
            {"growth", rates(result.growth)},
            {"verdict", json_verdicts(result.verdict)},
            {"log_dec", written(units, Quantity::number, result.log_dec)},
            {"unstable", speeds(result.unstable)},
            {"unstable_error", speeds(result.unstable_error)},
            {"ends", json_rows(end_columns, result.ends, units)},
            {"resolved_up_to", written(units, Quantity::frequency, result.resolved_up_to)},
            {"unresolved_ends", json_rows(end_columns, result.unresolved_ends, units)},
            {"resolved_growth", rates(result.resolved_growth)},
            {"resolved_verdict", json_verdicts(result.resolved_verdict)},
            {"resolved_unstable", speeds(result.resolved_unstable)},
            {"resolved_unstable_error", speeds(result.resolved_unstable_error)},
            {"unresolved_growth", rates(result.unresolved_growth)},
            {"critical_speeds", speeds(result.critical_speeds)},
            {"zero_root_speeds", speeds(result.zero_root_speeds)},
            {"additional_speeds", speeds(result.additional_speeds)},
            {"additional_speeds_damped", speeds(result.additional_speeds_damped)},
            {"permissible", json_rows(permissible_columns, result.permissible, units)},
            {"balanced_against", !result.all_imbalances   ? Json()
                                 : *result.all_imbalances ? Json("all imbalances")
                                                          : Json("own imbalance")},
            {"no_balanced_position", speeds(result.no_position)},
            {"neutral_pairs", result.neutral_pairs},
            {"harmonics", result.harmonics},
            {"family", result.family ? family_json(*result.family, units) : Json()},
            {"map", result.map ? map_json(*result.map, units) : Json()},
            {"level1", result.level1 ? level1_json(*result.level1, units) : Json()},
            {"clearances", json_list(result.clearances,
                                     [&units](const StabilityResult &one) {
                                         Json json = json_row(clearance_columns, one, units);
                                         json["level1"] =
                                             one.level1 ? level1_json(*one.level1, units) : Json();
                                         return json;
                                     })},
            {"states", states_json(result.states, units)},
            {"state_borders", state_borders_json(result.states, units)},
            {"states_undecided", states_undecided_json(result.states, units)},
            {"states_over", states_over_json(result.states, units)}};
}

std::string csv_of(const StabilityResult &result, const Units &units) {
    const Columns<BandLine> all = file_columns(result);
    std::vector<CsvHeading> head = csv_head(all);
    for (const CsvHeading &heading : csv_head(end_columns))
        if (std::find(head.begin(), head.end(), heading) == head.end())
            head.push_back(heading);
    const auto rows = [&](const std::vector<BandLine> &of) {
        return csv_rows(head, all, of, units);
    };
    std::string csv =
        csv_head_line(head, units) + rows(growth_lines(result)) +
        rows(band_lines("unstable", result.unstable, &result.unstable_error)) +
        rows(band_lines("unstable, resolved", result.resolved_unstable,
                        &result.resolved_unstable_error)) +
        csv_rows(head, end_columns, result.ends, units) +
        rows(speed_lines("critical speed", result.critical_speeds)) +
        rows(speed_lines("zero root", result.zero_root_speeds)) +
        rows(speed_lines("additional speed, undamped", result.additional_speeds)) +
        rows(speed_lines("additional speed, damped", result.additional_speeds_damped));
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
          speed_lines("additional: pinned at the balancers, undamped", result.additional_speeds),
          speed_lines("the same, damped: real part of a complex root",
                      result.additional_speeds_damped)})
        all.insert(all.end(), more.begin(), more.end());
    return all;
}

const Columns<BandLine> still_columns{
    {OnPage("Kind"), &BandLine::kind},
    {OnPage("", "{:.8g}").and_si("{:.10g}"), Quantity::speed, &BandLine::from}};

/// All clearances side by side, the least stable named; nothing where there is one.
std::vector<Section> clearance_sections(const StabilityResult &result, const Units &units) {
    if (result.clearances.empty())
        return {};
    return {{"Clearances of the bearings",
             element("p", least_stable_in_words(result)) +
                 page_table(clearance_columns, all_clearances(result), units)}};
}

std::vector<Section> sections_of(const StabilityResult &result, const Units &units) {
    std::vector<Section> sections = headline_sections(result, units);
    add_sections(sections, clearance_sections(result, units));
    add_table(sections, "Speeds at which the number of growing motions changes",
              without_empty(end_columns, result.ends), result.ends, units);
    add_table(sections, "The same of motions that the elements do not resolve",
              without_empty(end_columns, result.unresolved_ends), result.unresolved_ends, units);
    add_table(sections, "Speeds at which something stands still in rotating axes", still_columns,
              still_speeds(result), units);
    add_table(sections, "Permissible inertial anisotropy", permissible_columns, result.permissible,
              units);
    if (result.level1)
        add_sections(sections, level1_sections(*result.level1, units));
    if (result.states)
        add_sections(sections, states_sections(*result.states, units));
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
        sections.push_back({title, bands_section(*bands, units)});
    return sections;
}

std::string speeds_text(const std::string &title, const std::vector<double> &speeds,
                        const Units &units) {
    std::string text = title + ":";
    for (const double speed : speeds)
        text += " " + readable(units(Quantity::speed, speed),
                               units.style().digits > 0 ? units.style().digits : 10);
    return speeds.empty() ? "" : text + " " + units.name(Quantity::speed) + "\n";
}

std::string text_of(const model::Case &scene, const StabilityResult &result, const Units &units) {
    std::string text = heading(scene, "Stability, " + range_text(result.speeds, units));
    text += headline_text(result, units);
    if (!result.clearances.empty())
        text += "\n" + least_stable_in_words(result) + "\n" +
                text_table(clearance_columns, all_clearances(result), units);
    text += text_table("Speeds at which the number of growing motions changes:\n",
                       without_empty(end_columns, result.ends), result.ends, units);
    if (!result.unresolved_ends.empty())
        text += fmt::format("Not resolved by the elements: {} more {}, of motions with frequencies "
                            "above {}\n",
                            result.unresolved_ends.size(),
                            result.unresolved_ends.size() == 1 ? "end" : "ends",
                            units.text(Quantity::frequency, *result.resolved_up_to));
    text += speeds_text("Critical speeds, balls held, undamped", result.critical_speeds, units) +
            speeds_text("A root is zero at", result.zero_root_speeds, units) +
            speeds_text("Additional speeds (rotor pinned at the balancers), undamped",
                        result.additional_speeds, units) +
            speeds_text("The same, damped (real parts of complex roots)",
                        result.additional_speeds_damped, units);
    if (const auto &family = result.family)
        text += "\n" +
                bands_text(fmt::format("Unstable with some of {} arrangements of the balls",
                                       family->arrangements),
                           family->unstable, units) +
                bands_text("Unstable with every arrangement", family->always_unstable, units) +
                bands_text("Critical speeds over the arrangements", family->critical_speeds, units);
    text += text_table(result.speeds.size() == 1
                           ? "\nPermissible inertial anisotropy at this speed:\n"
                           : "\nPermissible inertial anisotropy over this range:\n",
                       permissible_columns, result.permissible, units);
    if (result.level1)
        text += level1_text(*result.level1, units);
    if (result.states)
        text += states_text(*result.states, units);
    return text + model_text(result.model, units);
}

std::vector<Section> brief_of(const StabilityResult &result, const Units &units) {
    std::vector<Section> sections = headline_sections(result, units);
    add_sections(sections, clearance_sections(result, units));
    if (result.level1)
        sections.push_back(
            {"Level-I stability", page_properties(level1_columns, *result.level1, units)});
    return sections;
}

} // namespace

Report describe(const model::Case &scene, const StabilityResult &result) {
    Report report =
        report_of<StabilityResult>("stability", "Stability", scene, result,
                                   {json_of, csv_of, sections_of, text_of, stability_chart});
    const bool states = result.states && !result.states->states.empty();
    if (result.level1 || states) {
        report.pictures = [&scene, &result, states](const Units &units) {
            std::vector<Picture> pictures;
            if (result.level1)
                pictures.push_back(level1_picture(scene, *result.level1, units));
            if (states)
                pictures.push_back({"states", states_chart(scene, *result.states, units), {}});
            return pictures;
        };
        report.pictures_heading = result.level1 && states
                                      ? "Added cross coupling, and steady states"
                                  : states ? "Steady states over speed"
                                           : "Logarithmic decrement over added cross coupling";
        report.pictures_after = sections_of(result, {}).size();
    }
    if (states)
        report.tables = [&result] { return std::vector{states_table(*result.states)}; };
    report.answer = stability_answer(result);
    if (const auto &level1 = result.level1; level1 && level1->critical_cross_coupling)
        report.answer += model::Sentence("; added cross coupling up to {} leaves it stable",
                                         model::as::stiffness(*level1->critical_cross_coupling, 5));
    report.brief = [&](const Units &units) { return brief_of(result, units); };
    return report;
}

} // namespace whirl::report
