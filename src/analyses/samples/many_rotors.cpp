#include "analyses/samples/many_rotors.h"

#include "model/errors.h"
#include "process/parallel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <sstream>

namespace whirl::analyses {

namespace {

using process::Outcome;

// A rotor's answers on their way between processes. One that failed has a reason and no numbers; of
// one that did not, the first number counts the answers, five follow for each and then what goes
// with the rotor, and the text has a line of words for each answer.

constexpr char between = '\t';
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

Outcome packed(const std::vector<Answer> &answers) {
    Outcome out;
    out.numbers.push_back(static_cast<double>(answers.size()));
    for (const Answer &answer : answers) {
        out.numbers.insert(out.numbers.end(),
                           {answer.value, answer.asked_for ? 1.0 : 0.0,
                            static_cast<double>(answer.quantity), answer.at.value_or(nothing),
                            static_cast<double>(answer.at_quantity)});
        for (std::string word : {answer.key, answer.of, answer.name, answer.behind}) {
            std::replace_if(
                word.begin(), word.end(), [](char c) { return c == between || c == '\n'; }, ' ');
            out.text += word + between;
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
            std::getline(words, *word, between);
        answers[i].value = outcome.numbers.at(1 + 5 * i);
        answers[i].asked_for = outcome.numbers.at(2 + 5 * i) != 0;
        answers[i].quantity = static_cast<model::Quantity>(outcome.numbers.at(3 + 5 * i));
        if (const double at = outcome.numbers.at(4 + 5 * i); !std::isnan(at))
            answers[i].at = at;
        answers[i].at_quantity = static_cast<model::Quantity>(outcome.numbers.at(5 + 5 * i));
    }
    return answers;
}

/// The reason without the override that names the rotor's own value, and without the value.
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

Outcome one_rotor(std::size_t i, const Answers &answers, const RotorOfMany &rotor) {
    try {
        std::vector<double> beside;
        Outcome out = packed(answers.of(rotor(i, beside)));
        out.numbers.insert(out.numbers.end(), beside.begin(), beside.end());
        return out;
    } catch (const model::Failure &problem) {
        return {{}, reason_of(problem.what())};
    }
}

std::optional<double> finite(double value) {
    return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

results::SampledAnswer empty_answer(const Answer &answer, int count) {
    results::SampledAnswer out;
    out.of = answer.of;
    if (!answer.at)
        out.name = results::Sentence("{}{}", answer.name, answer.behind);
    else if (answer.at_quantity == model::Quantity::speed)
        out.name =
            results::Sentence("{}{}{}", answer.name, results::as::speed(*answer.at), answer.behind);
    else
        out.name = results::Sentence("{}{}{}", answer.name, results::as::length(*answer.at),
                                     answer.behind);
    out.quantity = answer.quantity;
    out.values.resize(static_cast<std::size_t>(count));
    return out;
}

/// Answers of the case as it is first, then those that only other rotors have, in the order in
/// which they turn up.
class Table {
  public:
    Table(const std::vector<Answer> &nominal, int count) : _count(count) {
        for (const Answer &answer : nominal) {
            results::SampledAnswer &row = row_of(answer);
            row.nominal = finite(answer.value);
            row.nominal_error = finite(answer.error);
        }
    }
    /// What a rotor has beyond what is asked for counts only where others are asked for it.
    void find_rows(const std::vector<Answer> &answers) {
        for (const Answer &answer : answers)
            if (answer.asked_for)
                (void)row_of(answer);
    }
    void fill(std::size_t rotor, const std::vector<Answer> &answers) {
        for (const Answer &answer : answers)
            if (const auto found = _row.find(answer.key); found != _row.end())
                _rows[found->second].values[rotor] = finite(answer.value);
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

/// What two rotors that fail for one reason have in common: bounds that depend on other entries
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
void note_failure(const std::string &message, int rotor,
                  std::vector<results::SampleFailure> &failures) {
    const std::string kind = without_numbers(message);
    const auto same = std::ranges::find_if(failures, [&kind](const auto &failure) {
        return without_numbers(failure.message) == kind;
    });
    if (same == failures.end())
        failures.push_back({message, {rotor}});
    else
        same->samples.push_back(rotor);
}

} // namespace

ManyRotors answers_of_many(const Answers &answers, std::size_t count, const RotorOfMany &rotor,
                           const std::string &what) {
    ManyRotors out;
    const auto outcomes =
        process::deal(count, what, [&](std::size_t i) { return one_rotor(i, answers, rotor); });
    if (outcomes.empty())
        return out;
    Table table(answers.nominal(), static_cast<int>(count));
    out.beside.resize(count);
    std::vector<std::vector<Answer>> all(outcomes.size());
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
        if (outcomes[i].numbers.empty()) {
            note_failure(outcomes[i].text, static_cast<int>(i), out.failures);
            ++out.failed;
            continue;
        }
        all[i] = unpacked(outcomes[i]);
        out.beside[i].assign(outcomes[i].numbers.begin() +
                                 static_cast<std::ptrdiff_t>(1 + 5 * all[i].size()),
                             outcomes[i].numbers.end());
        table.find_rows(all[i]);
    }
    for (std::size_t i = 0; i < all.size(); ++i)
        table.fill(i, all[i]);
    out.answers = table.take();
    for (results::SampledAnswer &answer : out.answers)
        answer.present = static_cast<int>(std::ranges::count_if(
            answer.values, [](const auto &value) { return value.has_value(); }));
    if (out.failed == static_cast<int>(count))
        throw model::AnalysisFailure(
            fmt::format("each of the {} {} failed: {}", count, what, out.failures.front().message));
    return out;
}

} // namespace whirl::analyses
