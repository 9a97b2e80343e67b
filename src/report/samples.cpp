// Report of the command samples.

#include "results/samples.h"

#include "report/common/csv.h"
#include "report/common/table.h"
#include "report/common/words.h"
#include "report/pictures/figures.h"
#include "report/reports.h"

#include <fmt/format.h>

#include <algorithm>

namespace whirl::report {

using results::SampledAnswer;
using results::SampledInput;
using results::SampleFailure;
using results::SampleQuantile;
using results::SamplesResult;

namespace {

std::string of_and_name(const SampledAnswer &answer) {
    return answer.of == "critical"   ? "critical " + answer.name
           : answer.of == "ends"     ? "unstable " + answer.name
           : answer.of == "residual" ? "residual: " + answer.name
                                     : answer.name;
}

const Columns<SampleQuantile> quantile_columns{{"p", &SampleQuantile::share},
                                               {"value", &SampleQuantile::value},
                                               {"interval", [](const auto &q) {
                                                    return Json::array({q.low, q.high});
                                                }}};

/// The unit of an answer, and the factor of its values; amplitudes are the lengths among answers.
WrittenUnit unit_of(const SampledAnswer &answer) {
    if (answer.unit == "m")
        return {unit_name("amplitude", "µm"), micrometres};
    return written_unit(quantity_in(answer.unit), answer.unit);
}
auto in_its_unit(std::optional<double> SampledAnswer::*of) {
    return [of](const SampledAnswer &answer) { return times(unit_of(answer).factor, answer.*of); };
}

const Columns<SampledAnswer> answer_columns{
    {"of", &SampledAnswer::of},
    {"name", &SampledAnswer::name},
    {OnPage("Answer"), InText("answer"), of_and_name},
    {"unit", &SampledAnswer::unit},
    {ForReaders("unit"), [](const auto &answer) { return unit_of(answer).name; }},
    {"nominal", &SampledAnswer::nominal},
    {OnPage("case as it is", "{:.10g}"), InText("case as is", precise),
     in_its_unit(&SampledAnswer::nominal)},
    {"nominal_error", OnPage("its relative error", "{:.2g}"), InText("rel. error", rough),
     &SampledAnswer::nominal_error},
    {"quantiles", [](const auto &answer) { return json_rows(quantile_columns, answer.quantiles); }},
    {"mean", &SampledAnswer::mean},
    {OnPage("mean", "{:.6g}"), InText("mean"), in_its_unit(&SampledAnswer::mean)},
    {"mean_error", &SampledAnswer::mean_error},
    {OnPage("± (95 %)", "{:.2g}"), InText("+- 95 %", "{:.2g}"),
     in_its_unit(&SampledAnswer::mean_error)},
    {"deviation", &SampledAnswer::deviation},
    {OnPage("standard deviation", "{:.4g}"), InText("deviation"),
     in_its_unit(&SampledAnswer::deviation)},
    {"deviation_error", &SampledAnswer::deviation_error},
    {OnPage("± (95 %)", "{:.2g}"), InText("+- 95 %", "{:.2g}"),
     in_its_unit(&SampledAnswer::deviation_error)},
    {"present", ForReaders("samples"), &SampledAnswer::present},
    {"values", &SampledAnswer::values}};

/// A quantile with its answer, for readers.
struct SampleLine {
    const SampledAnswer &answer;
    const SampleQuantile &quantile;
};

auto in_its_unit(auto SampleQuantile::*of) {
    return [of](const SampleLine &line) {
        return times(unit_of(line.answer).factor, line.quantile.*of);
    };
}

/// 95 % of what the values are of: speeds are read in rpm, too.
Json in_rpm(const SampleLine &line) {
    return line.answer.unit == "rad/s" ? Json(line.quantile.value * rpm) : Json();
}

const Columns<SampleLine> sample_line_columns{
    {OnPage("Answer"), InText("answer"),
     [](const SampleLine &line) { return of_and_name(line.answer); }},
    {ForReaders("quantile"),
     [](const SampleLine &line) { return readable(100 * line.quantile.share) + " %"; }},
    {OnPage("rpm", "{:.6g}"), InText("rpm"), in_rpm},
    {OnPage("value", "{:.6g}"), InText("value"), in_its_unit(&SampleQuantile::value)},
    {ForReaders("unit"), [](const SampleLine &line) { return unit_of(line.answer).name; }},
    {OnPage("95 % from", "{:.6g}"), InText("95 % from"), in_its_unit(&SampleQuantile::low)},
    {OnPage("to", "{:.6g}"), InText("to"), in_its_unit(&SampleQuantile::high)}};

std::vector<SampleLine> lines_of(const SamplesResult &result) {
    std::vector<SampleLine> lines;
    for (const SampledAnswer &answer : result.answers)
        for (const SampleQuantile &quantile : answer.quantiles)
            lines.push_back({answer, quantile});
    return lines;
}

const Columns<SampledInput> input_columns{
    {"path", OnPage("Entry"), &SampledInput::path},
    {"unit", OnPage("unit"), &SampledInput::unit},
    {"distribution", OnPage("distribution"), &SampledInput::distribution},
    {"values", &SampledInput::values}};

const Columns<SampleFailure> failure_columns{
    {"message", OnPage("Why samples failed"), InText("why samples failed"),
     &SampleFailure::message},
    {"count", ForReaders("how many"),
     [](const SampleFailure &failure) { return failure.samples.size(); }},
    {OnPage("the first (counted from 0)"), InText("the first"),
     [](const SampleFailure &failure) { return failure.samples.front(); }},
    {"samples", &SampleFailure::samples}};

/// Heading in the file: names may hold commas.
std::string with_unit(const std::string &name, const std::string &unit) {
    return csv_cell(unit.empty() ? name : fmt::format("{} [{}]", name, unit));
}

/// Why a sample failed; empty: it did not.
std::string failure_of(const SamplesResult &result, int sample) {
    for (const SampleFailure &failure : result.failures)
        if (std::binary_search(failure.samples.begin(), failure.samples.end(), sample))
            return failure.message;
    return "";
}

/// A line a sample; its columns are the inputs and answers.
std::string csv_of(const SamplesResult &result, const Units &) {
    Json samples = Json::array();
    Json failures = Json::array();
    for (int sample = 0; sample < result.count; ++sample) {
        samples.push_back(sample);
        failures.push_back(failure_of(result, sample));
    }
    std::vector<std::pair<std::string, Json>> lists{{"sample", samples}};
    for (const SampledInput &input : result.inputs)
        lists.emplace_back(with_unit(input.path, input.unit), input.values);
    for (const SampledAnswer &answer : result.answers)
        lists.emplace_back(with_unit(of_and_name(answer), answer.unit), answer.values);
    lists.emplace_back("failure", failures);
    return csv_lists(lists);
}

Json json_of(const SamplesResult &result, const Units &) {
    return {{"samples",
             {{"count", result.count},
              {"failed", result.failed},
              {"seed", result.seed},
              {"failures", json_rows(failure_columns, result.failures)}}},
            {"inputs", json_rows(input_columns, result.inputs)},
            {"answers", json_rows(answer_columns, result.answers)}};
}

std::vector<Section> sections_of(const SamplesResult &result, const Units &) {
    std::vector<Section> sections{
        {"Quantiles", page_table(sample_line_columns, lines_of(result))},
        {"Mean and standard deviation", page_table(answer_columns, result.answers)},
        {"What varies", page_table(input_columns, result.inputs)}};
    if (!result.failures.empty())
        sections.push_back({"Failed samples", page_table(failure_columns, result.failures)});
    return sections;
}

std::string text_of(const model::Case &scene, const SamplesResult &result, const Units &) {
    std::string text =
        heading(scene, fmt::format("{} samples, seed {}", result.count, result.seed));
    text += result.answers.empty() ? "  no answers\n"
                                   : text_table(sample_line_columns, lines_of(result));
    return text + text_table("\n", answer_columns, result.answers) +
           text_table("\n", failure_columns, result.failures) + model_text(result.model);
}

} // namespace

Report describe(const model::Case &scene, const SamplesResult &result) {
    return report_of<SamplesResult>("samples", "Uncertain entries", scene, result,
                                    {json_of, csv_of, sections_of, text_of, samples_figure});
}

} // namespace whirl::report
