#include "analyses/samples/samples.h"

#include "analyses/samples/answers.h"
#include "analyses/samples/statistics.h"
#include "model/errors.h"
#include "process/parallel.h"
#include "process/progress.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <optional>
#include <sstream>

namespace whirl::analyses {

namespace {

using process::Outcome;

// A sample on its way between processes. One that failed has a reason and no numbers; of one that
// did not, the first number counts the answers, four follow for each, and the text has a line of
// their words for each.

constexpr char separator = '\t';
constexpr double no_place = std::numeric_limits<double>::quiet_NaN();

Outcome packed(const std::vector<Answer> &answers) {
    Outcome out;
    out.numbers.push_back(static_cast<double>(answers.size()));
    for (const Answer &answer : answers) {
        out.numbers.insert(out.numbers.end(),
                           {answer.value, answer.asked_for ? 1.0 : 0.0,
                            static_cast<double>(answer.quantity), answer.z.value_or(no_place)});
        for (std::string word : {answer.key, answer.of, answer.name, answer.behind}) {
            std::replace_if(
                word.begin(), word.end(), [](char c) { return c == separator || c == '\n'; }, ' ');
            out.text += word + separator;
        }
        out.text += '\n';
    }
    return out;
}

std::vector<Answer> unpacked(const Outcome &outcome) {
    std::vector<Answer> answers(static_cast<std::size_t>(outcome.numbers.at(0)));
    std::istringstream lines(outcome.text);
    for (std::size_t i = 0; i < answers.size(); ++i) {
        std::string line;
        std::getline(lines, line);
        std::istringstream words(line);
        for (std::string *word :
             {&answers[i].key, &answers[i].of, &answers[i].name, &answers[i].behind})
            std::getline(words, *word, separator);
        answers[i].value = outcome.numbers.at(1 + 4 * i);
        answers[i].asked_for = outcome.numbers.at(2 + 4 * i) != 0;
        answers[i].quantity = static_cast<model::Quantity>(outcome.numbers.at(3 + 4 * i));
        if (const double z = outcome.numbers.at(4 + 4 * i); !std::isnan(z))
            answers[i].z = z;
    }
    return answers;
}

/// The reason without the override that names the sample's own value, and without the value.
std::string reason_of(const std::string &message) {
    std::istringstream lines(message);
    std::string all;
    for (std::string line; std::getline(lines, line);) {
        if (const std::size_t end = line.find(": "); line.starts_with("--set "))
            line = line.substr(end == std::string::npos ? 0 : end + 2);
        line = line.substr(0, line.find(", got "));
        if (!line.empty())
            all += (all.empty() ? "" : "; ") + line;
    }
    return all.empty() ? "no reason given" : all;
}

Outcome one_sample(const std::vector<double> &values, const model::SamplesSettings &settings,
                   const Answers &answers, const CaseWith &with) {
    std::vector<std::string> overrides;
    for (std::size_t i = 0; i < values.size(); ++i)
        overrides.push_back(fmt::format("{}={}", settings.vary[i].path, values[i]));
    try {
        return packed(answers.of(with(overrides)));
    } catch (const model::Failure &problem) {
        return {{}, reason_of(problem.what())};
    }
}

std::string distribution_name(model::Distribution distribution) {
    switch (distribution) {
    case model::Distribution::normal:
        return "normal";
    case model::Distribution::uniform:
        return "uniform";
    case model::Distribution::values:
        break;
    }
    return "values";
}

std::optional<double> finite(double value) {
    return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

results::SampledAnswer empty_answer(const Answer &answer, int count) {
    results::SampledAnswer out;
    out.of = answer.of;
    out.name = answer.z ? results::Sentence("{}{}{}", answer.name, results::as::length(*answer.z),
                                            answer.behind)
                        : results::Sentence("{}{}", answer.name, answer.behind);
    out.quantity = answer.quantity;
    out.values.resize(static_cast<std::size_t>(count));
    return out;
}

/// Answers of the case as it is first, then those that only samples have, in the order in which
/// they turn up.
class Table {
  public:
    Table(const std::vector<Answer> &nominal, int count) : _count(count) {
        for (const Answer &answer : nominal) {
            results::SampledAnswer &row = row_of(answer);
            row.nominal = finite(answer.value);
            row.nominal_error = finite(answer.error);
        }
    }
    /// What a sample has beyond what is asked for counts only where others are asked for it.
    void find_rows(const std::vector<Answer> &answers) {
        for (const Answer &answer : answers)
            if (answer.asked_for)
                (void)row_of(answer);
    }
    void fill(std::size_t sample, const std::vector<Answer> &answers) {
        for (const Answer &answer : answers)
            if (const auto found = _row.find(answer.key); found != _row.end())
                _rows[found->second].values[sample] = finite(answer.value);
    }
    [[nodiscard]] std::vector<results::SampledAnswer> take() {
        // Together by what they are of, in the order of the first of each.
        std::ranges::stable_sort(_rows, {}, rank);
        return std::move(_rows);
    }

  private:
    int _count;
    std::vector<results::SampledAnswer> _rows;
    std::map<std::string, std::size_t> _row; ///< of a key

    results::SampledAnswer &row_of(const Answer &answer) {
        const auto [place, is_new] = _row.try_emplace(answer.key, _rows.size());
        if (is_new)
            _rows.push_back(empty_answer(answer, _count));
        return _rows[place->second];
    }
    [[nodiscard]] static int rank(const results::SampledAnswer &row) {
        return row.of == "critical" ? 0 : row.of == "peaks" ? 1 : 2;
    }
};

/// What two samples that fail for one reason have in common: bounds that depend on other entries
/// differ, the key in front does not.
std::string without_numbers(const std::string &message) {
    const std::size_t key_end = message.find(": expected");
    std::string out = message.substr(0, key_end == std::string::npos ? 0 : key_end);
    bool in_number = false;
    for (const char c : message.substr(out.size())) {
        const bool digit = std::isdigit(static_cast<unsigned char>(c)) != 0;
        in_number = digit || (in_number && (c == '.' || c == 'e' || c == '-' || c == '+'));
        if (!in_number)
            out += c;
    }
    return out;
}

/// @param message  of which the first of its kind is shown
void note_failure(const std::string &message, int sample,
                  std::vector<results::SampleFailure> &failures) {
    const std::string kind = without_numbers(message);
    const auto same = std::ranges::find_if(failures, [&kind](const auto &failure) {
        return without_numbers(failure.message) == kind;
    });
    if (same == failures.end())
        failures.push_back({message, {sample}});
    else
        same->samples.push_back(sample);
}

void add_answers(const std::vector<Outcome> &outcomes, const Answers &answers,
                 const std::vector<double> &shares, results::SamplesResult &result) {
    Table table(answers.nominal(), result.count);
    std::vector<std::vector<Answer>> all(outcomes.size());
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
        if (outcomes[i].numbers.empty()) {
            note_failure(outcomes[i].text, static_cast<int>(i), result.failures);
            ++result.failed;
            continue;
        }
        all[i] = unpacked(outcomes[i]);
        table.find_rows(all[i]);
    }
    for (std::size_t i = 0; i < all.size(); ++i)
        table.fill(i, all[i]);
    result.answers = table.take();
    for (results::SampledAnswer &answer : result.answers)
        describe_values(shares, answer);
}

void add_notes(results::SamplesResult &result) {
    auto &notes = result.model.notes;
    if (result.failed > 0)
        notes.emplace_back("{} of {} samples failed: quantiles are those of the others",
                           result.failed, result.count);
    if (result.answers.empty())
        notes.emplace_back("neither the case as it is nor any sample has an answer of the kinds "
                           "asked for in the range of speeds");
    const int sound = result.count - result.failed;
    if (std::ranges::any_of(result.answers,
                            [sound](const auto &answer) { return answer.present < sound; }))
        notes.emplace_back("not every sample has every answer: the same number need not be the "
                           "same motion there, and quantiles are of the samples that have it");
}

} // namespace

results::SamplesResult samples(const model::Case &scene, const CaseWith &with) {
    if (!scene.samples)
        throw model::BadInput(fmt::format("{}: samples: expected a section [samples] that says "
                                          "which entries vary, got none",
                                          scene.file.generic_string()));
    const model::SamplesSettings &settings = *scene.samples;
    std::optional<process::Stage> stage(std::in_place, "the case as it is", 0.0, 0.02);
    const Answers answers(scene);
    results::SamplesResult result;
    result.model = answers.model();
    result.count = settings.count;
    result.seed = settings.seed;
    for (const model::UncertainInput &input : settings.vary)
        result.inputs.push_back(
            {input.path, input.quantity, distribution_name(input.distribution), {}});
    std::vector<std::vector<double>> drawn;
    for (int i = 0; i < settings.count; ++i) {
        drawn.push_back(draw(settings, i));
        for (std::size_t k = 0; k < result.inputs.size(); ++k)
            result.inputs[k].values.push_back(drawn.back()[k]);
    }
    stage.emplace("samples", 0.02, 1.0);
    const auto outcomes = process::deal(drawn.size(), "samples", [&](std::size_t i) {
        return one_sample(drawn[i], settings, answers, with);
    });
    if (outcomes.empty())
        return result;
    add_answers(outcomes, answers, settings.quantiles, result);
    if (result.failed == result.count)
        throw model::AnalysisFailure(fmt::format("each of the {} samples failed: {}", result.count,
                                                 result.failures.front().message));
    add_notes(result);
    return result;
}

} // namespace whirl::analyses
