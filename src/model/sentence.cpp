#include "model/sentence.h"

#include <fmt/format.h>

#include <cmath>
#include <ostream>
#include <stdexcept>
#include <utility>

namespace whirl::model {

namespace {

/// "3", "3 to 4" (where they differ), "1, 2 and 3" in a unit, and its name.
std::string value_text(const Value &value, const Unit &unit) {
    std::string text;
    const bool one = value.from_to && value.numbers.front() == value.numbers.back();
    for (std::size_t i = 0; i < (one ? 1 : value.numbers.size()); ++i) {
        const bool last = i + 1 == value.numbers.size();
        text += i == 0 ? "" : value.from_to ? " to " : last ? " and " : ", ";
        text += value.sign && value.numbers[i] > 0 ? "+" : "";
        text += readable(value.numbers[i] * unit.factor, value.digits);
    }
    if (!unit.name.empty())
        text += " " + unit.name + (unit.peak_to_peak ? " pk-pk" : "");
    return text;
}

} // namespace

std::string readable(double value, int digits) {
    if (!std::isfinite(value))
        return std::isnan(value) ? "unknown" : value < 0 ? "minus infinity" : "infinity";
    std::string text = fmt::format("{:.{}g}", value, digits);
    constexpr double long_number = 1e6;
    if (std::abs(value) < 1 || text.find('e') == std::string::npos)
        return text;
    const double rounded = std::stod(text);
    return std::abs(rounded) < long_number ? fmt::format("{:.0f}", rounded) : text; // 1230
}

Sentence::Sentence(const char *words) : _pieces{{words, {}}} {}
Sentence::Sentence(const std::string &words) : _pieces{{words, {}}} {}

Sentence Sentence::part(const Value &value) {
    Sentence out;
    out._pieces.push_back({"", value});
    return out;
}

Sentence Sentence::part(std::string_view words) {
    Sentence out;
    out._pieces.push_back({std::string(words), {}});
    return out;
}

void Sentence::take(std::string_view pattern, const std::vector<Sentence> &parts) {
    std::size_t from = 0;
    for (const Sentence &next : parts) {
        const std::size_t at = pattern.find("{}", from);
        if (at == std::string_view::npos)
            throw std::logic_error(fmt::format("no place for a value in \"{}\"", pattern));
        *this += part(pattern.substr(from, at - from));
        *this += next;
        from = at + 2;
    }
    *this += part(pattern.substr(from));
}

Sentence &Sentence::operator+=(const Sentence &more) {
    _pieces.insert(_pieces.end(), more._pieces.begin(), more._pieces.end());

    return *this;
}

std::string Sentence::text() const {
    return text([](Quantity quantity) { return Unit{names_of(quantity).si, 1, false}; });
}

std::string Sentence::text(const UnitOf &units) const {
    std::string text;
    for (const Piece &piece : _pieces)
        text += piece.value.numbers.empty() ? piece.words
                                            : value_text(piece.value, units(piece.value.of));
    return text;
}

std::string Sentence::pattern() const {
    std::string text;
    for (const Piece &piece : _pieces)
        text += piece.value.numbers.empty() ? piece.words : "{}";
    return text;
}

std::ostream &operator<<(std::ostream &stream, const Sentence &sentence) {
    return stream << sentence.text();
}

Sentence joined(const std::vector<Sentence> &sentences, const char *between) {
    Sentence out;
    for (const Sentence &sentence : sentences) {
        if (&sentence != &sentences.front())
            out += Sentence("{}", between);
        out += sentence;
    }
    return out;
}

} // namespace whirl::model
