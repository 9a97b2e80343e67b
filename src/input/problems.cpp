#include "input/problems.h"

#include "model/errors.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <numeric>

namespace whirl::input {
namespace {

/// Levenshtein's edit distance; letters that differ in case only count as equal.
std::size_t edit_distance(std::string_view left, std::string_view right) {
    const auto same = [](char a, char b) {
        return std::tolower(static_cast<unsigned char>(a)) ==
               std::tolower(static_cast<unsigned char>(b));
    };
    std::vector<std::size_t> row(right.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= left.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= right.size(); ++j) {
            const std::size_t replaced = diagonal + (same(left[i - 1], right[j - 1]) ? 0 : 1);
            diagonal = row[j];
            row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
        }
    }
    return row.back();
}

/// The candidate nearest to `word` (fewest edits), or empty where none is near enough to be meant.
std::string nearest(std::string_view word, const std::vector<std::string> &candidates) {
    constexpr std::size_t longest = 100; // nobody slips in more
    if (word.size() > longest)
        return "";
    // Two edits are a slip in a short word; in a long one, a third of its letters.
    std::size_t least = std::max<std::size_t>(2, word.size() / 3) + 1;
    std::string best;
    for (const std::string &candidate : candidates) {
        const std::size_t distance = edit_distance(word, candidate);
        if (distance < least && distance < std::max(word.size(), candidate.size())) {
            least = distance;
            best = candidate;
        }
    }
    return best;
}

} // namespace

std::string Origin::text() const { return line > 0 ? fmt::format("{}:{}", file, line) : file; }

std::string Problem::message() const {
    return origin.text() + ": " + (key.empty() ? "" : key + ": ") + text;
}

void Problems::add(Origin origin, std::string key, std::string text) {
    constexpr std::size_t most = 1000; // more than anyone reads
    if (_problems.size() < most)
        _problems.push_back({std::move(origin), std::move(key), std::move(text)});
    else
        ++_more;
}

std::vector<Problem> Problems::sorted() const {
    // Files in the order in which they come up.
    const auto place = [this](const Problem &problem) {
        const auto same_file = [&](const Problem &other) {
            return other.origin.file == problem.origin.file;
        };
        return std::pair(std::ranges::find_if(_problems, same_file) - _problems.begin(),
                         problem.origin.line);
    };
    std::vector<Problem> sorted = _problems;
    std::ranges::stable_sort(sorted, {}, place);
    return sorted;
}

void Problems::throw_if_any() const {
    if (_problems.empty())
        return;
    std::string message;
    for (const Problem &problem : sorted()) {
        message += message.empty() ? "" : "\n";
        message += problem.message();
    }
    if (_more > 0)
        message += fmt::format("\nand {} more", _more);
    throw model::BadInput(message);
}

std::string did_you_mean(std::string_view word, const std::vector<std::string> &candidates) {
    const std::string best = nearest(word, candidates);
    return best.empty() ? "" : fmt::format(", did you mean \"{}\"?", best);
}

std::string suggestion(std::string_view word, const std::vector<std::string> &candidates) {
    std::string best = did_you_mean(word, candidates);
    if (!best.empty())
        return best;
    return candidates.empty() ? "" : fmt::format(", known are {}", fmt::join(candidates, ", "));
}

std::string digits_apart(double value, double other) {
    std::string text = fmt::format("{:.6g}", value);
    return value != other && text == fmt::format("{:.6g}", other) ? fmt::format("{}", value) : text;
}

std::string decimal_comma_hint(std::string_view text) {
    const std::size_t comma = text.find(',');
    const auto digit = [text](std::size_t k) {
        return k < text.size() && std::isdigit(static_cast<unsigned char>(text[k])) != 0;
    };
    const bool decimal =
        comma != std::string_view::npos && comma > 0 && digit(comma - 1) && digit(comma + 1);
    return decimal ? "; write the decimal point as \".\"" : "";
}

} // namespace whirl::input
