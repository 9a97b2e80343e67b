// Report of the command samples.

#include "results/samples.h"

#include "report/answers.h"
#include "report/common/words.h"
#include "report/pictures/figures.h"
#include "report/reports.h"
#include "report/sections.h"

#include <fmt/format.h>

#include <array>
#include <cstdlib>
#include <numeric>

namespace whirl::report {

namespace {

/// A number in words, so that none stands in front of a unit: "first", "second", "13th".
std::string ordinal(const std::string &number) {
    constexpr std::array words{"first",   "second", "third", "fourth", "fifth",    "sixth",
                               "seventh", "eighth", "ninth", "tenth",  "eleventh", "twelfth"};
    const auto n = static_cast<std::size_t>(std::atoi(number.c_str()));
    return n >= 1 && n <= words.size() ? words[n - 1] : number + "th";
}

} // namespace

std::string answer_text(const results::SampledAnswer &answer, const Units &units) {
    const std::string name = units.text(answer.name);
    if (answer.of == "critical" && !name.empty() && name.front() >= '0' && name.front() <= '9')
        return ordinal(name) + " critical";
    return answer.of == "critical"   ? "critical " + name
           : answer.of == "ends"     ? "unstable " + name
           : answer.of == "residual" ? "residual: " + name
           : answer.of == "margins"  ? "margin of " + name
                                     : name;
}

using results::SampledAnswer;
using results::SampledInput;
using results::SampleFailure;
using results::SampleQuantile;
using results::SamplesResult;

Columns<SampledAnswer> answer_names() {
    return {
        {"of", &SampledAnswer::of},
        {"name", [](const auto &answer, const Units &units) { return units.text(answer.name); }},
        {Titled("Answer"), answer_text},
        {"unit", ForReaders("unit"),
         [](const auto &answer, const Units &units) { return units.name(answer.quantity); }}};
}

Columns<SampleFailure> failure_columns(const std::string &heading, const std::string &rotors) {
    return {{"message", Titled(heading), &SampleFailure::message},
            {"count", ForReaders("how many"),
             [](const auto &failure) { return failure.samples.size(); }},
            {OnPage("the first (counted from 0)"), InText("the first"),
             [](const auto &failure) { return failure.samples.front(); }},
            {rotors, &SampleFailure::samples}};
}

void add_answers(std::vector<CsvList> &lists, const std::vector<SampledAnswer> &answers,
                 const std::vector<SampleFailure> &failures, int rotors, const Units &units) {
    for (const SampledAnswer &answer : answers)
        lists.push_back({{answer_text(answer, units), answer.quantity}, answer.values});
    std::vector<std::string> messages(static_cast<std::size_t>(rotors));
    for (const SampleFailure &failure : failures)
        for (const int rotor : failure.samples)
            messages[static_cast<std::size_t>(rotor)] = failure.message;
    lists.push_back({{"failure"}, messages});
}

namespace {

/// A quantile with its answer.
struct SampleLine {
    const SampledAnswer &answer;
    const SampleQuantile &quantile;
};
auto of_quantile(auto SampleQuantile::*of) {
    return [of](const SampleLine &line) { return line.quantile.*of; };
}
const OfEach of_line{[](const SampleLine &line) { return line.answer.quantity; }};

const Columns<SampleLine> quantile_columns{
    {"p", Quantity::number, of_quantile(&SampleQuantile::share)},
    {"value", of_line, of_quantile(&SampleQuantile::value)},
    {"interval", of_line, [](const SampleLine &line) {
         return Json::array({line.quantile.low, line.quantile.high});
     }}};

std::vector<SampleLine> lines_of(const SampledAnswer &answer) {
    std::vector<SampleLine> lines;
    for (const SampleQuantile &quantile : answer.quantiles)
        lines.push_back({answer, quantile});
    return lines;
}

const OfEach of_answer{[](const SampledAnswer &answer) { return answer.quantity; }};

const Columns<SampledAnswer> answer_columns = and_then(
    answer_names(), {{"nominal", OnPage("case as it is", "{:.10g}"), InText("case as is", precise),
                      of_answer, &SampledAnswer::nominal},
                     {"nominal_error", OnPage("its relative error", "{:.2g}"),
                      InText("rel. error", rough), Quantity::number, &SampledAnswer::nominal_error},
                     {"quantiles", Quantity::number,
                      [](const auto &answer, const Units &units) {
                          return json_rows(quantile_columns, lines_of(answer), units);
                      }},
                     {"mean", ForReaders("mean"), of_answer, &SampledAnswer::mean},
                     {"mean_error", OnPage("± (95 %)", "{:.2g}"), InText("+- 95 %", "{:.2g}"),
                      of_answer, &SampledAnswer::mean_error},
                     {"deviation", OnPage("standard deviation", "{:.4g}"), InText("deviation"),
                      of_answer, &SampledAnswer::deviation},
                     {"deviation_error", OnPage("± (95 %)", "{:.2g}"), InText("+- 95 %", "{:.2g}"),
                      of_answer, &SampledAnswer::deviation_error},
                     {"present", ForReaders("samples"), &SampledAnswer::present},
                     {"values", of_answer, &SampledAnswer::values}});

const Columns<SampleLine> sample_line_columns{
    {Titled("Answer"),
     [](const SampleLine &line, const Units &units) { return answer_text(line.answer, units); }},
    {ForReaders("quantile"),
     [](const SampleLine &line) { return readable(100 * line.quantile.share) + " %"; }},
    {ForReaders("value"), of_line, of_quantile(&SampleQuantile::value)},
    {ForReaders("unit"),
     [](const SampleLine &line, const Units &units) { return units.name(line.answer.quantity); }},
    {ForReaders("95 % from"), of_line, of_quantile(&SampleQuantile::low)},
    {ForReaders("to"), of_line, of_quantile(&SampleQuantile::high)}};

std::vector<SampleLine> lines_of(const SamplesResult &result) {
    std::vector<SampleLine> lines;
    for (const SampledAnswer &answer : result.answers)
        for (const SampleQuantile &quantile : answer.quantiles)
            lines.push_back({answer, quantile});
    return lines;
}

const Columns<SampledInput> input_columns{
    {"path", OnPage("Entry"), &SampledInput::path},
    {"unit", OnPage("unit"),
     [](const auto &input, const Units &units) { return units.name(input.quantity); }},
    {"distribution", OnPage("distribution"), &SampledInput::distribution},
    {"values", OfEach{[](const SampledInput &input) { return input.quantity; }},
     &SampledInput::values}};

const Columns<SampleFailure> sample_failures = failure_columns("Why samples failed", "samples");

/// A line a sample; its columns are the inputs and answers.
std::string csv_of(const SamplesResult &result, const Units &units) {
    std::vector<int> numbers(static_cast<std::size_t>(result.count));
    std::iota(numbers.begin(), numbers.end(), 0);
    std::vector<CsvList> lists{{{"sample"}, numbers}};
    for (const SampledInput &input : result.inputs)
        lists.push_back({{input.path, input.quantity}, input.values});
    add_answers(lists, result.answers, result.failures, result.count, units);
    return csv_lists(lists, units);
}

Json json_of(const SamplesResult &result, const Units &units) {
    return {{"samples",
             {{"count", result.count},
              {"failed", result.failed},
              {"seed", result.seed},
              {"failures", json_rows(sample_failures, result.failures, units)}}},
            {"inputs", json_rows(input_columns, result.inputs, units)},
            {"answers", json_rows(answer_columns, result.answers, units)}};
}

std::vector<Section> sections_of(const SamplesResult &result, const Units &units) {
    std::vector<Section> sections{
        {"Quantiles", page_table(sample_line_columns, lines_of(result), units)},
        {"Mean and standard deviation", page_table(answer_columns, result.answers, units)},
        {"What varies", page_table(input_columns, result.inputs, units)}};
    add_table(sections, "Failed samples", sample_failures, result.failures, units);
    return sections;
}

std::string text_of(const model::Case &scene, const SamplesResult &result, const Units &units) {
    std::string text =
        heading(scene, fmt::format("{} samples, seed {}", result.count, result.seed));
    text += result.answers.empty() ? "  no answers\n"
                                   : text_table(sample_line_columns, lines_of(result), units);
    return text + text_table("\n", answer_columns, result.answers, units) +
           text_table("\n", sample_failures, result.failures, units) +
           model_text(result.model, units);
}

} // namespace

Report describe(const model::Case &scene, const SamplesResult &result) {
    return report_of<SamplesResult>("samples", "Uncertain entries", scene, result,
                                    {json_of, csv_of, sections_of, text_of, samples_chart});
}

} // namespace whirl::report
