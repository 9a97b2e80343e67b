#include "marked_texts.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <pugixml.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <string_view>

namespace whirl::tests {

using model::Quantity;

namespace {

bool digit(char c) { return c >= '0' && c <= '9'; }
bool letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }

constexpr std::array<std::string_view, 10> superscripts{"⁰", "¹", "²", "³", "⁴",
                                                        "⁵", "⁶", "⁷", "⁸", "⁹"};
/// A power of ten in superscripts, taken off at `at`.
std::optional<int> raised(const std::string &text, std::size_t &at) {
    std::size_t next = at;
    const std::string_view minus = "⁻";
    const bool negative = text.compare(next, minus.size(), minus) == 0;
    next += negative ? minus.size() : 0;
    std::optional<int> value;
    for (bool found = true; found;) {
        found = false;
        for (std::size_t k = 0; k < superscripts.size() && !found; ++k)
            if (text.compare(next, superscripts[k].size(), superscripts[k]) == 0) {
                value = 10 * value.value_or(0) + static_cast<int>(k);
                next += superscripts[k].size();
                found = true;
            }
    }
    if (value)
        at = next;
    return value && negative ? -*value : value;
}

double scale_of(int power) { return std::pow(10, power); }

/// What cells of numbers alone hold.
constexpr const char *of_cells = "0123456789.e+-… ,;to|–";

std::vector<std::string> lines_of(const std::string &text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);)
        lines.push_back(line);
    return lines;
}

std::string collapsed(const std::string &text) {
    std::string out;
    for (const char c : text)
        if (c != ' ' || (!out.empty() && out.back() != ' '))
            out += c;
    while (!out.empty() && out.back() == ' ')
        out.pop_back();
    return out;
}

/// With # in place of numbers.
std::string without_numbers(const std::string &text, const std::vector<Number> &numbers) {
    std::string out;
    std::size_t from = 0;
    for (const Number &number : numbers) {
        out += text.substr(from, number.begin - from) + "#";
        from = number.end;
    }
    return collapsed(out + text.substr(from));
}

void replace_all(std::string &text, const std::string &from, const std::string &to) {
    for (std::size_t at = text.find(from); at != std::string::npos;
         at = text.find(from, at + to.size()))
        text.replace(at, from.size(), to);
}

/// A unit, one that others are asked for in the place of, that a text names beside a number or in
/// brackets; remarks on a case speak of those of its keys.
std::string plain_unit(const std::string &text, const std::vector<Number> &numbers) {
    if (text.find("/(m0") != std::string::npos || // a formula of masses
        text.find("unless it has a unit") != std::string::npos ||
        text.find("with a unit, ") != std::string::npos)
        return "";
    const std::string words = without_numbers(text, numbers) + " ";
    for (const std::string unit : {"rad/s", "rpm", "Hz", "m", "mm", "um", "µm", "N", "N/m", "kg",
                                   "kg m2", "kg m²", "kg m", "g mm", "N s/m"})
        for (const std::string before : {"# ", "("})
            for (std::size_t at = words.find(before + unit); at != std::string::npos;
                 at = words.find(before + unit, at + 1)) {
                const std::string after = words.substr(at + before.size() + unit.size());
                if (at > 0 && words[at - 1] == '/') // of "µm/(g mm)", which has no entry
                    continue;
                // "N m/rad" and "kg m2/s" are other units.
                const bool goes_on = after.size() > 2 && after[0] == ' ' &&
                                     (after[1] == 'm' || after[1] == 's') &&
                                     std::isalpha(static_cast<unsigned char>(after[2])) == 0;
                const bool ends =
                    before == "(" ? after[0] == ')' : std::strchr(" ),;:.", after[0]) != nullptr;
                if (ends && !goes_on)
                    return unit;
            }
    return "";
}

/// The mark that a text has at `at`, longest first.
std::optional<Quantity> mark_at(const std::string &text, std::size_t at) {
    std::size_t end = at + std::strlen("§");
    if (text.compare(at, end - at, "§") != 0)
        return std::nullopt;
    while (end < text.size() && letter(text[end]))
        ++end;
    const std::string key = text.substr(at, end - at);
    for (std::size_t i = 0; i < model::quantities; ++i)
        if (const auto of = static_cast<Quantity>(i); mark_of(of) == key) {
            const bool pk_pk = text.compare(end, 6, " pk-pk") == 0;
            return of == Quantity::amplitude && !pk_pk ? Quantity::deflection : of;
        }
    return std::nullopt;
}

} // namespace

Compared &Compared::operator+=(const Compared &more) {
    numbers += more.numbers;
    converted += more.converted;
    rough += more.rough;
    return *this;
}

std::vector<Number> numbers_of(const std::string &text) {
    std::vector<Number> numbers;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (!digit(text[i]))
            continue;
        std::size_t end = i;
        int decimals = 0;
        int digits = 0;
        bool point = false;
        for (; end < text.size() &&
               (digit(text[end]) ||
                (text[end] == '.' && !point && end + 1 < text.size() && digit(text[end + 1])));
             ++end) {
            point = point || text[end] == '.';
            decimals += point && text[end] != '.' ? 1 : 0;
            digits += digit(text[end]) && (digits > 0 || text[end] != '0') ? 1 : 0;
        }
        const bool in_word = i > 0 && (letter(text[i - 1]) || text[i - 1] == '.');
        double value = std::strtod(text.substr(i, end - i).c_str(), nullptr);
        int power = 0;
        char *tail = nullptr;
        if (end + 1 < text.size() && text[end] == 'e' &&
            (digit(text[end + 1]) || text[end + 1] == '+' || text[end + 1] == '-')) {
            power = static_cast<int>(std::strtol(text.c_str() + end + 1, &tail, 10));
            end = static_cast<std::size_t>(tail - text.c_str());
        } else if (const std::string_view ten = "·10"; text.compare(end, ten.size(), ten) == 0) {
            std::size_t at = end + ten.size();
            if (const auto of_ten = raised(text, at)) {
                power = *of_ten;
                end = at;
            }
        } else if (value == 10 && digits == 2) {
            if (const auto of_ten = raised(text, end)) { // 10⁶ alone
                value = 1;
                digits = 1;
                power = *of_ten;
            }
        }
        constexpr int most = 10; // that are written; "{:#.10g}" puts a zero behind its point
        double last = std::pow(10, -decimals) * scale_of(power);
        if (digits > most)
            last *= std::pow(10, digits - most);
        if (decimals == 0 && power == 0) // 1230 may be all of three digits
            for (std::size_t k = end; k > i + 1 && text[k - 1] == '0'; --k)
                last *= 10;
        digits = std::min(digits, most);
        const bool before_word = end < text.size() && letter(text[end]);
        const std::string_view minus = "−";
        std::size_t begin = i;
        if (i > 0 && text[i - 1] == '-' &&
            (i == 1 || (!letter(text[i - 2]) && !digit(text[i - 2]))))
            begin = i - 1;
        else if (i >= minus.size() && text.compare(i - minus.size(), minus.size(), minus) == 0)
            begin = i - minus.size();
        if (!in_word && !before_word)
            numbers.push_back(
                {begin, end, (begin < i ? -1 : 1) * value * scale_of(power), last, digits});
        i = end - 1;
    }
    return numbers;
}

std::optional<Quantity> MarkedTexts::quantity_in(const std::string &heading) {
    const std::size_t at = heading.rfind("§");
    if (at == std::string::npos)
        return std::nullopt;
    auto found = mark_at(heading, at);
    if (found == Quantity::deflection && heading.find("pk-pk") != std::string::npos)
        return Quantity::amplitude;
    return found;
}

double MarkedTexts::ratio(Quantity quantity) const {
    const double twice = quantity == Quantity::amplitude ? (_peak_to_peak ? 1 : 0.5) : 1;
    const std::string name = _units.unit(quantity).name;
    const bool has_mark = *names_of(quantity).key != '\0';
    return has_mark ? twice * mark_size(quantity) / size_of(name) : 1;
}

std::string MarkedTexts::words(std::string marked) const {
    if (!_peak_to_peak) {
        replace_all(marked, " pk-pk", "");
        replace_all(marked, "pk-pk ", "");
    }
    for (std::size_t i = 0; i < model::quantities; ++i) {
        const auto of = static_cast<Quantity>(i);
        if (*names_of(of).key != '\0')
            replace_all(marked, mark_of(of), _units.unit(of).name);
    }
    return marked;
}

/// Of numbers in front of a unit: "3 §spe", "3 to 4 §spe", "1, 2 and 3 §spe".
MarkedTexts::Quantities MarkedTexts::own_quantities(const std::string &marked,
                                                    const std::vector<Number> &numbers) {
    Quantities out(numbers.size());
    for (std::size_t i = numbers.size(); i-- > 0;) {
        const std::size_t end = numbers[i].end;
        if (marked.compare(end, 1, " ") == 0)
            out[i] = mark_at(marked, end + 1);
        if (out[i] || i + 1 == numbers.size() || !out[i + 1])
            continue;
        const std::string between = marked.substr(end, numbers[i + 1].begin - end);
        for (const char *joint : {" ", " to ", ", ", " and ", " … ", " | ", " ... "})
            if (between == joint || between == std::string(joint) + "+")
                out[i] = out[i + 1];
    }
    return out;
}

std::string MarkedTexts::difference(const std::string &marked, const std::string &other,
                                    const Quantities &quantities) {
    const auto a = numbers_of(marked);
    const auto b = numbers_of(other);
    if (const std::string unit = plain_unit(marked, a); !unit.empty())
        return "a number in " + unit + ", whatever is asked for";
    // Words with the marks in place, whose keys hold no digits.
    const std::string wanted = words(without_numbers(marked, a));
    // A unit such as "kg m2" has digits that are no numbers.
    const std::string found = without_numbers(other, b);
    if (collapsed(wanted) != found || a.size() != b.size())
        return "words: " + collapsed(wanted) + " | " + found;
    std::string out;
    Compared here;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const std::string number = marked.substr(a[i].begin, a[i].end - a[i].begin);
        const std::string written = other.substr(b[i].begin, b[i].end - b[i].begin);
        if (!quantities[i]) {
            if (number != written)
                out += fmt::format("{} without a unit is {}; ", number, written);
            continue;
        }
        const double times = ratio(*quantities[i]);
        const double want = a[i].value * times;
        const double slack = 1e-12 * std::abs(want);
        const int digits = std::max(a[i].digits, b[i].digits);
        const auto place = [digits](double value) {
            return value == 0 ? 0
                              : std::pow(10, std::floor(std::log10(std::abs(value))) + 1 - digits);
        };
        const double off = std::abs(b[i].value - want);
        ++here.numbers;
        here.converted += times != 1 ? 1 : 0;
        if (off <= 0.51 * (place(a[i].value) * times + place(b[i].value)) + slack)
            continue;
        ++here.rough;
        if (off > 0.51 * (a[i].last * times + b[i].last) + slack)
            out += fmt::format("{} {} is {}, not {}; ", number, names_of(*quantities[i]).name,
                               written, want);
    }
    compared += here;
    return out;
}

void MarkedTexts::expect_same(const std::string &marked, const std::string &other,
                              const Quantities &quantities) {
    const std::string found = difference(marked, other, quantities);
    EXPECT_EQ(found, "") << _where << "\n" << marked << "\n" << other;
}

void MarkedTexts::compare(const std::string &marked, const std::string &other) {
    expect_same(marked, other, own_quantities(marked, numbers_of(marked)));
}

/// What a cell says of other numbers: "§spe", "amplitude pk-pk (§amp)".
std::optional<Quantity> MarkedTexts::quantity_of_row(const std::vector<std::string> &cells) {
    for (const std::string &cell : cells)
        if (cell.starts_with("§") ||
            (cell.ends_with(')') && cell.rfind("(§") != std::string::npos &&
             cell.rfind("(§") == cell.rfind('(')))
            return quantity_in(cell);
    return std::nullopt;
}

/// Numbers of a row in which another cell names the unit; those that are no ratios.
void MarkedTexts::by_row(const std::string &marked, const std::string &other,
                         const std::vector<Number> &numbers, Quantities &quantities) const {
    std::vector<std::string> cells;
    for (std::size_t at = marked.find_first_not_of(' '); at != std::string::npos;) {
        const std::size_t end = std::min(marked.find("   ", at), marked.size());
        cells.push_back(marked.substr(at, end - at));
        at = marked.find_first_not_of(' ', end);
    }
    const auto of = quantity_of_row(cells);
    const auto in_other = numbers_of(other);
    if (!of || cells.size() < 3 || numbers.empty() || numbers.size() != in_other.size())
        return;
    bool any =
        ratio(*of) == 1 ||
        std::ranges::all_of(quantities,
                            [](const auto &own) {
                                return own.has_value(); // nothing is left for the unit of the row
                            }) ||
        std::ranges::find(cells, "no limit") != cells.end(); // in the place of its number
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const bool differs = marked.substr(numbers[i].begin, numbers[i].end - numbers[i].begin) !=
                             other.substr(in_other[i].begin, in_other[i].end - in_other[i].begin);
        if (!quantities[i] && differs)
            quantities[i] = of;
        any = any || differs || numbers[i].value == 0;
    }
    EXPECT_TRUE(any) << _where << "\n" << marked << "\n" << other;
}

namespace {

/// Where the letters of a line begin, in bytes, and the end of it.
std::vector<std::size_t> letters_of(const std::string &line) {
    std::vector<std::size_t> at;
    for (std::size_t i = 0; i < line.size(); ++i)
        if ((line[i] & 0xC0) != 0x80)
            at.push_back(i);
    at.push_back(line.size());
    return at;
}
bool cell_ends(const std::string &line, std::size_t at) {
    return at == line.size() || line.compare(at, 3, "   ") == 0;
}

/// What the heading of the column says whose cells end at a letter of a line; those of the first
/// begin below it.
std::optional<Quantity> column_quantity(const std::vector<std::string> &lines,
                                        const std::vector<std::vector<std::size_t>> &letters,
                                        std::size_t line, std::size_t letter, bool first) {
    while (line-- > 0 && !lines[line].empty()) {
        if (letter >= letters[line].size() && !first)
            continue;
        std::string cell;
        if (first) {
            cell = lines[line].substr(0, lines[line].find("   ", 2));
        } else {
            const std::size_t end = letters[line][letter];
            if (end == 0 || lines[line][end - 1] == ' ' || !cell_ends(lines[line], end))
                continue;
            cell = lines[line].substr(0, end);
            const std::size_t gap = cell.rfind("   ");
            cell.erase(0, gap == std::string::npos ? 0 : gap + 3);
        }
        if (const auto of = MarkedTexts::quantity_in(cell); of && numbers_of(cell).empty())
            return of;
    }
    return std::nullopt;
}

} // namespace

void MarkedTexts::compare_terminal(const std::string &marked, const std::string &other) {
    const auto a = lines_of(marked);
    const auto b = lines_of(other);
    ASSERT_EQ(a.size(), b.size()) << _where << marked << other;
    std::vector<std::vector<std::size_t>> letters;
    letters.reserve(a.size());
    for (const std::string &line : a)
        letters.push_back(letters_of(line));
    for (std::size_t k = 0; k < a.size(); ++k) {
        const auto numbers = numbers_of(a[k]);
        Quantities quantities = own_quantities(a[k], numbers);
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            const std::size_t end = std::min(a[k].find("   ", numbers[i].end), a[k].size());
            const std::size_t gap = a[k].rfind("   ", numbers[i].begin);
            const std::size_t begin = gap == std::string::npos ? 0 : gap + 3;
            if (quantities[i] ||
                a[k].substr(begin, end - begin).find_first_not_of(of_cells) != std::string::npos)
                continue;
            const auto letter = std::find(letters[k].begin(), letters[k].end(), end);
            quantities[i] = column_quantity(a, letters, k,
                                            static_cast<std::size_t>(letter - letters[k].begin()),
                                            numbers[i].begin == 2);
        }
        by_row(a[k], b[k], numbers, quantities);
        expect_same(a[k], b[k], quantities);
    }
}

namespace {

using Cells = std::vector<std::string>;
struct Html {
    std::vector<std::vector<Cells>> tables;
    std::vector<std::string> texts;
};

std::string inner_text(pugi::xml_node node) {
    std::string out;
    for (const pugi::xml_node child : node.children())
        out += child.type() == pugi::node_element ? inner_text(child) : child.value();
    return out;
}

void collect(pugi::xml_node node, Html &out) {
    for (const pugi::xml_node child : node.children()) {
        const std::string name = child.name();
        if (name == "table") {
            out.tables.emplace_back();
            for (const auto &row : child.select_nodes(".//tr")) {
                out.tables.back().emplace_back();
                for (const pugi::xml_node cell : row.node().children())
                    out.tables.back().back().push_back(inner_text(cell));
            }
        } else if (name == "div" || name == "ul" || name == "section" || name == "details") {
            collect(child, out);
        } else {
            out.texts.push_back(inner_text(child));
        }
    }
}

Html html_of(const std::string &html) {
    pugi::xml_document document;
    Html out;
    const auto done = document.load_string(("<div>" + html + "</div>").c_str(),
                                           pugi::parse_default | pugi::parse_ws_pcdata_single);
    EXPECT_TRUE(done) << done.description() << html.substr(0, 400);
    collect(document.first_child(), out);
    return out;
}

} // namespace

void MarkedTexts::compare_html(const std::string &marked, const std::string &other) {
    const Html a = html_of(marked);
    const Html b = html_of(other);
    ASSERT_EQ(a.texts.size(), b.texts.size()) << _where;
    for (std::size_t i = 0; i < a.texts.size(); ++i)
        compare(a.texts[i], b.texts[i]);
    ASSERT_EQ(a.tables.size(), b.tables.size()) << _where;
    for (std::size_t t = 0; t < a.tables.size(); ++t) {
        ASSERT_EQ(a.tables[t].size(), b.tables[t].size()) << _where;
        const Cells &head = a.tables[t].front();
        for (std::size_t r = 0; r < a.tables[t].size(); ++r) {
            const Cells &row = a.tables[t][r];
            const Cells &row_b = b.tables[t][r];
            ASSERT_EQ(row.size(), row_b.size()) << _where << ::testing::PrintToString(head);
            const auto of_row = quantity_of_row(row);
            for (std::size_t i = 0; i < row.size(); ++i) {
                const auto numbers = numbers_of(row[i]);
                Quantities quantities = own_quantities(row[i], numbers);
                const auto of_column = i < head.size() ? quantity_of_row({head[i]}) : std::nullopt;
                const bool cell_of_numbers =
                    row[i].find_first_not_of(of_cells) == std::string::npos;
                for (auto &quantity : quantities)
                    if (!quantity && r > 0 && cell_of_numbers)
                        quantity = of_column;
                if (r > 0 && of_row && !of_column && cell_of_numbers && row[i] != row_b[i])
                    std::ranges::fill(quantities, of_row);
                expect_same(row[i], row_b[i], quantities);
            }
        }
    }
}

void MarkedTexts::compare_labels(const std::vector<std::string> &marked,
                                 const std::vector<std::string> &other,
                                 const std::vector<Quantity> &axes) {
    std::vector<bool> used(marked.size(), false);
    for (const std::string &text : other) {
        ++labels;
        bool found = false;
        for (std::size_t i = 0; i < marked.size() && !found; ++i) {
            if (used[i])
                continue;
            const auto numbers = numbers_of(marked[i]);
            const auto fits = [&](const Quantities &quantities) {
                const Compared before = compared;
                const bool same = difference(marked[i], text, quantities).empty();
                if (!same)
                    compared = before;
                return same;
            };
            found = fits(own_quantities(marked[i], numbers));
            const bool alone =
                numbers.size() == 1 && numbers[0].begin == 0 && numbers[0].end == marked[i].size();
            for (std::size_t k = 0; k < axes.size() && alone && !found; ++k)
                found = fits({axes[k]});
            used[i] = found;
        }
        labels_without_match += found ? 0 : 1;
        if (!found)
            unmatched += text + "\n";
    }
}

} // namespace whirl::tests
