// Report of the command sweep.

#include "results/sweep.h"

#include "report/answers.h"
#include "report/common/words.h"
#include "report/pictures/figures.h"
#include "report/reports.h"
#include "report/sections.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <optional>

namespace whirl::report {

using model::SweepAxis;
using results::SampledAnswer;
using results::SampleFailure;
using results::SweepResult;

namespace {

const Columns<SweepAxis> axis_columns{
    {"entries", entries_of},
    {OnPage("Entries"),
     [](const SweepAxis &axis) { return fmt::format("{}", fmt::join(entries_of(axis), ", ")); }},
    {"change", OnPage("change"), [](const SweepAxis &axis) { return change_name(axis.change); }},
    {"dimensionless", OnPage("until the rotor has the dimensionless number"), Quantity::number,
     [](const SweepAxis &axis) {
         return axis.dimensionless ? Json(axis.dimensionless->name) : Json();
     }},
    {"balancer", Quantity::number,
     [](const SweepAxis &axis) {
         return axis.dimensionless && axis.dimensionless->balancer
                    ? Json(*axis.dimensionless->balancer)
                    : Json();
     }},
    {"unit", OnPage("unit"),
     [](const SweepAxis &axis, const Units &units) { return units.name(axis.quantity); }},
    {"values", OfEach{[](const SweepAxis &axis) { return axis.quantity; }}, &SweepAxis::values}};

/// A value of each rotor as lists over the first axis, one for each value of the second.
Json lists_of(const SweepResult &result, const std::vector<std::optional<double>> &values) {
    if (result.axes.size() < 2)
        return values;
    Json lists = Json::array();
    const std::size_t across = result.axes.front().values.size();
    for (std::size_t i = 0; i < values.size(); i += across) {
        Json list = Json::array();
        for (std::size_t k = i; k < i + across; ++k)
            list.push_back(values[k] ? Json(*values[k]) : Json());
        lists.push_back(list);
    }
    return lists;
}

/// The axes, with what became of the entries of those over a dimensionless number.
Json axes_json(const SweepResult &result, const Units &units) {
    Json axes = json_rows(axis_columns, result.axes, units);
    for (std::size_t i = 0; i < result.axes.size(); ++i) {
        std::vector<std::optional<double>> changes;
        for (const std::vector<double> &rotor : result.changes)
            changes.push_back(i < rotor.size() ? std::optional(rotor[i]) : std::nullopt);
        // In SI, as numbers in the case file: the unit of the axis is that of the number.
        axes[i]["changes"] = result.axes[i].dimensionless ? lists_of(result, changes) : Json();
    }
    return axes;
}

template <class Better> std::optional<double> extreme(const SampledAnswer &answer, Better better) {
    std::optional<double> best;
    for (const std::optional<double> &value : answer.values)
        if (value && (!best || better(*value, *best)))
            best = value;
    return best;
}

const OfEach of_swept_answer{[](const SampledAnswer &answer) { return answer.quantity; }};

Columns<SampledAnswer> swept_answer_columns(const SweepResult &result) {
    return and_then(
        answer_names(),
        {{"nominal", OnPage("case as it is", "{:.6g}"), InText("case as is", "{:.6g}"),
          of_swept_answer, &SampledAnswer::nominal},
         {"nominal_error", OnPage("its relative error", "{:.2g}"), Quantity::number,
          &SampledAnswer::nominal_error},
         {ForReaders("smallest", "{:.6g}"), of_swept_answer,
          [](const SampledAnswer &answer) { return extreme(answer, std::less<>()); }},
         {ForReaders("largest", "{:.6g}"), of_swept_answer,
          [](const SampledAnswer &answer) { return extreme(answer, std::greater<>()); }},
         {"present", ForReaders("rotors"), &SampledAnswer::present},
         {"values", of_swept_answer,
          [&result](const SampledAnswer &answer) { return lists_of(result, answer.values); }}});
}

const Columns<SampleFailure> rotor_failures =
    failure_columns("Why rotors have no answer", "rotors");

/// The value of an axis at each rotor.
std::vector<double> along(const SweepResult &result, std::size_t axis) {
    std::size_t repeat = 1;
    for (std::size_t i = 0; i < axis; ++i)
        repeat *= result.axes[i].values.size();
    const std::vector<double> &values = result.axes[axis].values;
    std::vector<double> out;
    for (int i = 0; i < result.count; ++i)
        out.push_back(values[static_cast<std::size_t>(i) / repeat % values.size()]);
    return out;
}

/// A line a rotor; its columns are the entries and answers.
std::string sweep_csv(const SweepResult &result, const Units &units) {
    std::vector<CsvList> lists;
    for (std::size_t i = 0; i < result.axes.size(); ++i)
        lists.push_back({{axis_name(result.axes[i]), result.axes[i].quantity}, along(result, i)});
    add_answers(lists, result.answers, result.failures, result.count, units);
    return csv_lists(lists, units);
}

Json sweep_json(const SweepResult &result, const Units &units) {
    return {{"sweep",
             {{"axes", axes_json(result, units)},
              {"count", result.count},
              {"failed", result.failed},
              {"failures", json_rows(rotor_failures, result.failures, units)}}},
            {"answers", json_rows(swept_answer_columns(result), result.answers, units)}};
}

/// A rotor as a row of a table for readers.
struct SweepRow {
    std::size_t rotor = 0;
};

/// Entries and the first answers. @param most  answers
Columns<SweepRow> table_columns(const SweepResult &result, std::size_t most, const Units &units) {
    Columns<SweepRow> columns;
    for (std::size_t i = 0; i < result.axes.size(); ++i)
        columns.push_back(
            {ForReaders(axis_name(result.axes[i]), "{:.6g}"), result.axes[i].quantity,
             [values = along(result, i)](const SweepRow &row) { return values[row.rotor]; }});
    for (std::size_t i = 0; i < std::min(most, result.answers.size()); ++i) {
        const SampledAnswer &answer = result.answers[i];
        columns.push_back({ForReaders(answer_text(answer, units), "{:.6g}"), answer.quantity,
                           [&answer](const SweepRow &row) { return answer.values[row.rotor]; }});
    }
    return columns;
}

/// At most so many rotors, evenly spread, with the first and the last.
std::vector<SweepRow> table_rows(const SweepResult &result, std::size_t most) {
    const auto count = static_cast<std::size_t>(result.answers.empty() ? 0 : result.count);
    std::vector<SweepRow> rows;
    for (const std::size_t rotor : spread_over(count, most))
        rows.push_back({rotor});
    return rows;
}

constexpr std::size_t rows_on_page = 200;
constexpr std::size_t answers_on_page = 10;

std::vector<Section> sweep_sections(const SweepResult &result, const Units &units) {
    std::vector<Section> sections{
        {"Answers", page_table(swept_answer_columns(result), result.answers, units)},
        {"Values", page_table(table_columns(result, answers_on_page, units),
                              table_rows(result, rows_on_page), units)},
        {"What changes", page_table(axis_columns, result.axes, units)}};
    add_table(sections, "Rotors without an answer", rotor_failures, result.failures, units);
    return sections;
}

std::string sweep_text(const model::Case &scene, const SweepResult &result, const Units &units) {
    constexpr std::size_t rows = 16; // so that all stays on one screen
    constexpr std::size_t answers = 5;
    std::string text = heading(scene, fmt::format("sweep over {} rotors", result.count));
    text += result.answers.empty() ? "  no answers\n"
                                   : text_table(table_columns(result, answers, units),
                                                table_rows(result, rows), units);
    if (result.answers.size() > answers || static_cast<std::size_t>(result.count) > rows)
        text += fmt::format("  {} answers of {} rotors in sweep.csv\n", result.answers.size(),
                            result.count);
    return text + text_table("\n", rotor_failures, result.failures, units) +
           model_text(result.model, units);
}

} // namespace

Report describe(const model::Case &scene, const SweepResult &result) {
    return report_of<SweepResult>("sweep", "Sweep", scene, result,
                                  {sweep_json, sweep_csv, sweep_sections, sweep_text, sweep_chart});
}

} // namespace whirl::report
