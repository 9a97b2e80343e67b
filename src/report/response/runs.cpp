#include "report/response/parts.h"

#include "report/common/html.h"
#include "report/common/margins.h"
#include "report/common/table.h"
#include "report/common/words.h"
#include "report/response/tables.h"
#include "results/resonances.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace whirl::report {

using results::OperatingWorst;
using results::ResponseResult;
using results::SeparationMargin;
using results::StandardRun;

namespace {

const Columns<model::Imbalance> weight_columns{
    {"z", Quantity::length, &model::Imbalance::z},
    {"mr", Quantity::imbalance, &model::Imbalance::mr},
    {"phase", Quantity::angle, &model::Imbalance::phase}};

/// "21.4 g mm at z = 0.5 m and 20.1 g mm, opposite, at ..."
std::string weights_in_words(const StandardRun &run, const Units &units) {
    std::string out;
    for (const model::Imbalance &one : run.unbalance)
        out += fmt::format(
            "{}{} at {}{}", out.empty() ? "" : ", ", units.text(Quantity::imbalance, one.mr, 4),
            units.text(Quantity::length, one.z, 4),
            one.phase == 0 ? "" : " (" + units.text(Quantity::angle, one.phase, 4) + ")");
    return out;
}

/// The limit that is broken, or of which most is used.
const OperatingWorst *most_used(const StandardRun &run) {
    const OperatingWorst *most = nullptr;
    const auto order = [](const OperatingWorst &worst) {
        return std::pair(worst.pass.has_value() && !*worst.pass, worst.value / worst.limit);
    };
    for (const OperatingWorst &worst : run.operating.worst)
        if (!std::isnan(worst.value) && (!most || order(worst) > order(*most)))
            most = &worst;
    return most;
}

std::optional<double> use_in_percent(const StandardRun &run) {
    const OperatingWorst *worst = most_used(run);
    return worst ? std::optional(100 * worst->value / worst->limit) : std::nullopt;
}

std::string limit_in_words(const StandardRun &run, const Units &units) {
    const OperatingWorst *worst = most_used(run);
    if (!worst)
        return "";
    const auto said = [&](double value) {
        if (std::isinf(value))
            return std::string("no limit");
        return worst->what == results::Measure::clearance_share
                   ? fmt::format("{:.4g} %", 100 * value)
                   : units.text(results::measure_quantity(worst->what), value, 4);
    };
    return fmt::format("{} {}: {} of {} at {}", worst->of, place(worst->name, worst->z, units),
                       said(worst->value), said(worst->limit),
                       units.text(Quantity::speed, worst->speed, 5));
}

/// The largest value of a kind at any operating speed.
template <class Value>
std::optional<double> largest(const StandardRun &run, const char *of, Value value) {
    std::optional<double> most;
    for (const results::OperatingRow &row : run.operating.rows)
        if (const std::optional<double> one = value(row);
            row.of == of && one && !std::isnan(*one) && (!most || *one > *most))
            most = one;
    return most;
}
std::optional<double> largest_reading(const StandardRun &run) {
    const auto value = [](const auto &row) { return std::optional(row.amplitude); };
    const auto probe = largest(run, "probe", value);
    return probe ? probe : largest(run, "station", value);
}
std::optional<double> largest_force(const StandardRun &run) {
    return largest(run, "bearing", [](const auto &row) { return row.force; });
}

/// Checks of a run together: limits and margins.
std::string outcome_of(const StandardRun &run) {
    bool unknown = false;
    bool fails = false;
    for (const OperatingWorst &worst : run.operating.worst) {
        unknown = unknown || !worst.pass;
        fails = fails || (worst.pass && !*worst.pass);
    }
    for (const SeparationMargin &margin : run.margins)
        fails = fails || !margin.passes;
    return fails ? "fails" : unknown ? "not judged" : "passes";
}

std::string margins_in_words(const StandardRun &run) {
    const auto kept = std::ranges::count_if(run.margins, &SeparationMargin::passes);
    return run.margins.empty() ? "none needed" : fmt::format("{} of {}", kept, run.margins.size());
}

const Columns<StandardRun> run_columns{
    {"name", ForReaders("run"), &StandardRun::name},
    {"clearance", ForReaders("clearance"),
     [](const StandardRun &run) { return model::fit_name(run.fit); }},
    {Titled("Imbalances"), weights_in_words},
    {OnPage("Probes (else stations) move at most", "{:.5g}", "no limit"),
     InText("largest motion", "{:.5g}", "no limit"), Quantity::amplitude, largest_reading},
    {OnPage("Bearings carry at most", "{:.5g}", "no limit"),
     InText("bearings carry", "{:.5g}", "no limit"), Quantity::force, largest_force},
    {Titled("Nearest to its limit"), limit_in_words},
    {OnPage("Limit used (%)", "{:.4g}", "no limit"), InText("used %", "{:.4g}", "no limit"),
     Quantity::number, use_in_percent},
    {Titled("Margins kept"), margins_in_words},
    {ForReaders(""), outcome_of}};

std::string worst_in_words(const ResponseResult &result, const Units &units) {
    const std::string said = result.worst_run ? units.text(result.worst_run_text) : "not known";
    return result.runs.size() == 1
               ? "The one standard run is " + said + "."
               : fmt::format("The worst of {} standard runs is {}.", result.runs.size(), said);
}

/// Folded: each is about a margin of one run.
std::string notes_html(const ResponseResult &result, const Units &units) {
    std::string list;
    for (const StandardRun &run : result.runs)
        for (const model::Sentence &note : run.notes)
            list += "<li>" + escaped(units.text(results::run_name(run)) + ": " + units.text(note)) +
                    "</li>";
    return list.empty() ? ""
                        : "<details><summary>Notes on margins of the runs</summary><ul>" + list +
                              "</ul></details>";
}

} // namespace

void add_runs(Json &json, const ResponseResult &result, const Units &units) {
    if (result.runs.empty())
        return;
    json["runs"] = json_list(result.runs, [&units](const StandardRun &run) {
        Json one{{"name", run.name},
                 {"clearance", model::fit_name(run.fit)},
                 {"placed_by", written(units, Quantity::speed, run.placed_by)},
                 {"unbalance", json_rows(weight_columns, run.unbalance, units)}};
        take_entries(one, operating_json(run.operating, units));
        std::vector<results::ResponsePeak> peaks = sharpest_first(run.peaks);
        one["resonances"] = resonances_json(results::resonances_of(peaks), units);
        one["peaks"] = json_rows(curve_peaks(), peaks, units);
        add_margins(one, run.margins, units);
        one["notes"] = written(units, run.notes);
        return one;
    });
    json["worst_run"] = {{"index", result.worst_run ? Json(*result.worst_run) : Json()},
                         {"text", units.text(result.worst_run_text)}};
}

std::vector<Section> run_sections(const ResponseResult &result, const Units &units) {
    if (result.runs.empty())
        return {};
    return {{"Standard runs", "<p>" + escaped(worst_in_words(result, units)) + "</p>" +
                                  page_table(run_columns, result.runs, units) +
                                  notes_html(result, units)}};
}

std::string worst_run_text(const ResponseResult &result, const Units &units) {
    return result.runs.empty() ? "" : worst_in_words(result, units) + "\n\n";
}

std::string runs_text(const ResponseResult &result, const Units &units) {
    return text_table("Standard runs:\n", run_columns, result.runs, units) +
           (result.runs.empty() ? "" : "\n");
}

std::string runs_csv(const ResponseResult &result, const Units &units) {
    std::vector<results::OperatingRow> rows;
    std::vector<const StandardRun *> of;
    for (const StandardRun &run : result.runs) {
        rows.insert(rows.end(), run.operating.rows.begin(), run.operating.rows.end());
        of.insert(of.end(), run.operating.rows.size(), &run);
    }
    using Row = results::OperatingRow;
    return operating_csv(
        {{InCsv("run"), [&of](const Row &, std::size_t index) { return of[index]->name; }},
         {InCsv("clearance"),
          [&of](const Row &, std::size_t index) { return model::fit_name(of[index]->fit); }}},
        rows, units);
}

} // namespace whirl::report
