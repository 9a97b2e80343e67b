#include "input/csv_table.h"

#include "input/unit_spelling.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <functional>
#include <numbers>

namespace whirl::input {
namespace {

/// Without blanks at its ends; tabs may be separators.
std::string_view without_blanks(std::string_view text, char separator) {
    const std::string_view blanks = separator == '\t' ? " \r" : " \t\r";
    const std::size_t first = text.find_first_not_of(blanks);
    if (first == std::string_view::npos)
        return {};
    return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// Takes a cell in quotation marks off the start of `rest`; two of them inside stand for one. Empty
/// where none ends the cell.
std::optional<std::string> take_quoted(std::string_view &rest) {
    std::string cell;
    std::size_t start = 1;
    while (true) {
        const std::size_t mark = rest.find('"', start);
        if (mark == std::string_view::npos)
            return std::nullopt;
        cell += rest.substr(start, mark - start);
        start = mark + 1;
        if (start == rest.size() || rest[start] != '"')
            break;
        cell += '"';
        ++start;
    }
    rest.remove_prefix(start);
    return std::string(trimmed(cell));
}

/// What a spreadsheet puts in place of a number that it cannot compute, in its languages: #DIV/0!,
/// #N/A, #BEZUG!, Err:502. Such a cell is no comment.
bool is_spreadsheet_error(std::string_view cell) {
    if (cell == "#N/A" || cell == "#NV" || cell == "#N/D" || cell == "#NA" || cell == "#Н/Д" ||
        cell.starts_with("Err:"))
        return true;
    if (cell.size() < 4 || cell[0] != '#' || (cell.back() != '!' && cell.back() != '?'))
        return false;
    return std::ranges::all_of(cell.substr(1, cell.size() - 2), [](char c) {
        return (c >= 'A' && c <= 'Z') || c == '/' || c == '0' ||
               static_cast<unsigned char>(c) >= 0x80;
    });
}

/// What it says, with the kind of error where that is in English.
std::string told(std::string_view cell) {
    constexpr std::array<std::pair<std::string_view, std::string_view>, 6> kinds{
        {{"#DIV/0!", "a division by zero"},
         {"#N/A", "a value that is not available"},
         {"#REF!", "a reference to a cell that is gone"},
         {"#VALUE!", "a formula on something that is no number"},
         {"#NAME?", "a formula with an unknown name"},
         {"#NUM!", "a number that cannot be"}}};
    for (const auto &[name, meaning] : kinds)
        if (cell == name)
            return fmt::format("{}, an error of the spreadsheet: {}", cell, meaning);
    return fmt::format("{}, an error of the spreadsheet", cell);
}

/// A column too narrow for its numbers is written as a row of '#'.
bool is_too_narrow(std::string_view cell) {
    return cell.size() >= 3 && cell.find_first_not_of('#') == cell.npos;
}

struct Cells {
    std::vector<std::string> cells;
    const char *mistake = nullptr; ///< what is wrong with its quotation marks
};

/// Cells of a line without white space and quotation marks around them, up to a comment.
Cells split(std::string_view rest, char separator) {
    Cells line;
    const std::string ends{separator, '#'};
    while (true) {
        rest = without_blanks(rest, separator);
        if (rest.starts_with('"')) {
            const std::optional<std::string> cell = take_quoted(rest);
            if (!cell)
                return {{},
                        "expected a quotation mark at the end of a cell that starts with one, in "
                        "the same line"};
            line.cells.push_back(*cell);
            rest = without_blanks(rest, separator);
            if (!rest.empty() && rest[0] != separator && rest[0] != '#')
                return {{},
                        separator == ',' ? "expected a comma after the quotation mark that ends a "
                                           "cell"
                                         : "expected a separator after the quotation mark that "
                                           "ends a cell"};
        } else {
            std::size_t end = std::min(rest.find_first_of(ends), rest.size());
            const std::size_t whole = std::min(rest.find(separator), rest.size());
            const std::string_view cell = without_blanks(rest.substr(0, whole), separator);
            if (is_spreadsheet_error(cell) || (is_too_narrow(cell) && !line.cells.empty()))
                end = whole;
            line.cells.emplace_back(without_blanks(rest.substr(0, end), separator));
            rest.remove_prefix(end);
        }
        if (rest.empty() || rest[0] != separator)
            return line;
        rest.remove_prefix(1);
    }
}

/// The name and the unit of a header cell, "speed [rpm]" or "speed (rpm)".
struct Heading {
    std::string name;
    std::optional<std::string> unit;
};
Heading heading_of(std::string_view cell) {
    const std::size_t bracket = std::min(cell.find_first_of("[("), cell.size());
    Heading out{std::string(trimmed(cell.substr(0, bracket))), {}};
    if (bracket < cell.size()) {
        std::string_view unit = cell.substr(bracket + 1);
        unit = unit.substr(0, cell[bracket] == '[' ? unit.find(']') : unit.rfind(')'));
        out.unit = trimmed(unit);
    }
    return out;
}

/// A unit of a column, without the words that say how a vibration is read.
struct ColumnUnit {
    std::string unit;
    std::optional<double> amplitude; ///< of a harmonic vibration for a reading of 1
};
ColumnUnit column_unit(std::string_view text, Quantity quantity) {
    struct Words {
        std::string_view words;
        double amplitude;
    };
    // The longest first where one is in another.
    static constexpr std::array readings{Words{"peak-to-peak", 0.5},
                                         Words{"peak to peak", 0.5},
                                         Words{"pk-pk", 0.5},
                                         Words{"pkpk", 0.5},
                                         Words{"p-p", 0.5},
                                         Words{"pp", 0.5},
                                         Words{"0-peak", 1},
                                         Words{"0-pk", 1},
                                         Words{"0-p", 1},
                                         Words{"peak", 1},
                                         Words{"pk", 1},
                                         Words{"rms", std::numbers::sqrt2}};
    ColumnUnit out{std::string(text), {}};
    if (quantity != Quantity::amplitude && quantity != Quantity::influence)
        return out;
    for (const Words &one : readings) {
        const std::size_t at = text.find(one.words);
        const std::size_t end = at + one.words.size();
        if (at == std::string_view::npos || at == 0 || text[at - 1] != ' ' ||
            (end < text.size() && text[end] != ' ' && text[end] != '/'))
            continue;
        out.unit = std::string(trimmed(text.substr(0, at))) + std::string(text.substr(end));
        out.amplitude = one.amplitude;
        break;
    }
    return out;
}

/// The column that a heading without a name means by its unit: "rpm" is a speed. Null where several
/// have such a unit.
const CsvRule *rule_of_unit(const std::string &heading, const std::vector<CsvRule> &rules) {
    const CsvRule *only = nullptr;
    for (const CsvRule &rule : rules)
        if (rule.quantity && unit_factor(heading, *rule.quantity)) {
            if (only)
                return nullptr;
            only = &rule;
        }
    return only;
}

const CsvRule *rule_named(const std::string &name, const std::vector<CsvRule> &rules) {
    const auto found = std::ranges::find(rules, name, &CsvRule::name);
    return found == rules.end() ? nullptr : &*found;
}

/// The separator with which most cells of the header are columns; of those alike the one with which
/// fewest are none, or where none is a column, the one with most cells.
char separator_of(std::string_view header, const std::vector<CsvRule> &rules) {
    char best = ',';
    std::pair<std::ptrdiff_t, std::ptrdiff_t> most{0, 1};
    for (const char separator : {',', ';', '\t'}) {
        const std::vector<std::string> cells = split(header, separator).cells;
        const auto known = std::ranges::count_if(cells, [&](const std::string &cell) {
            const std::string name = heading_of(cell).name;
            return rule_named(name, rules) || rule_of_unit(name, rules);
        });
        const auto others = std::ranges::count_if(cells, std::not_fn(&std::string::empty)) - known;
        const std::pair score{known, known > 0 ? -others : std::ssize(cells)};
        if (score > most) {
            best = separator;
            most = score;
        }
    }
    return best;
}

/// Lines of a text, ended by \n, \r\n or \r.
class LineReader {
  public:
    explicit LineReader(std::string_view text) : _rest(text) {}
    std::optional<std::string_view> next() {
        if (_rest.empty())
            return std::nullopt;
        const std::size_t end = std::min(_rest.find_first_of("\r\n"), _rest.size());
        const std::string_view line = _rest.substr(0, end);
        _rest.remove_prefix(end);
        if (!_rest.empty())
            _rest.remove_prefix(_rest.starts_with("\r\n") ? 2 : 1);
        return line;
    }

  private:
    std::string_view _rest;
};

/// Blanks of all widths and the minus sign of typesetting. Units keep their signs.
constexpr std::array plain_blanks{Replacement{"\u00a0", " "}, Replacement{"\u2007", " "},
                                  Replacement{"\u2009", " "}, Replacement{"\u202f", " "},
                                  Replacement{"\ufeff", " "}, Replacement{"\u2212", "-"}};

/// How the digits of a number are written.
struct Digits {
    std::size_t commas = 0, points = 0;
    std::size_t comma = 0; ///< place of the only comma
    bool grouped = false;  ///< its only sign stands before the last three digits, as in 1,234
};
Digits digits_of(std::string_view cell) {
    Digits out;
    std::size_t at = cell.starts_with('-') || cell.starts_with('+') ? 1 : 0;
    const std::size_t first = at;
    std::size_t sign = 0;
    for (; at < cell.size() && (is_digit(cell[at]) || cell[at] == ',' || cell[at] == '.'); ++at)
        if (!is_digit(cell[at])) {
            (cell[at] == ',' ? out.commas : out.points) += 1;
            out.comma = cell[at] == ',' ? at : out.comma;
            sign = at;
        }
    const bool exponent = at < cell.size() && (cell[at] == 'e' || cell[at] == 'E');
    out.grouped = out.commas + out.points == 1 && at - sign == 4 && sign - first <= 3 &&
                  sign > first && cell[first] != '0' && !exponent;
    return out;
}

} // namespace

CsvTable::CsvTable(const CheckedEntry &asked, const std::vector<CsvRule> &rules)
    : _problems(&asked.context.problems) {
    const auto file = (asked.context.folder / asked.node.text).lexically_normal();
    _file = file.generic_string();
    const auto &[text, mistake] = asked.context.files.of(file, largest_table);
    if (!mistake.empty())
        asked.fail(fmt::format("expected a CSV table, got {}: {}", _file, mistake));
    else
        read(replaced_signs(is_utf8(text) ? text : from_latin1(text), plain_blanks), rules);
}

void CsvTable::read(std::string_view text, const std::vector<CsvRule> &rules) {
    LineReader lines(text);
    char separator = 0; // until the header
    bool first = true;
    bool units_may_follow = true;
    for (int number = 1; const auto line = lines.next(); ++number) {
        std::string_view content = trimmed(*line);
        if (content.empty())
            continue;
        if (std::exchange(first, false) && line->size() == 5 && line->starts_with("sep=")) {
            separator = line->back(); // of Excel
            continue;
        }
        if (separator == 0 && !content.starts_with('#'))
            separator = separator_of(content, rules);
        if (content.starts_with('#') &&
            (separator == 0 || split(content, separator).cells.front().empty()))
            continue;
        auto [cells, mistake] = split(*line, separator);
        if (mistake) {
            refuse(number, "", mistake);
            if (_columns.empty())
                return;
        } else if (_columns.empty()) {
            read_header({number, cells}, rules);
            if (_columns.empty())
                return;
        } else if (!std::exchange(units_may_follow, false) || !read_units({number, cells})) {
            add_line({number, std::move(cells)});
        }
    }
    if (_columns.empty())
        fail("", "expected a header line, the table is empty");
    else if (_usable && _lines.empty())
        fail("", "expected rows below the header, there are none");
    _usable = _usable && !_lines.empty();
    if (_usable)
        read_decimal_commas(separator);
}

void CsvTable::refuse(int line, const std::string &column, std::string text) {
    _problems->add({_file, line}, column, std::move(text));
    _usable = false;
}

void CsvTable::read_header(const Line &line, const std::vector<CsvRule> &rules) {
    std::vector<std::string> cells = line.cells;
    while (cells.size() > 1 && cells.back().empty())
        cells.pop_back(); // columns that a spreadsheet had and cleared
    _header_line = line.number;
    _usable = true;
    if (cells.size() == 1 && rule_named(cells[0].substr(0, cells[0].find(' ')), rules) &&
        !rule_named(heading_of(cells[0]).name, rules)) {
        fail("", "expected commas, semicolons or tabs between the columns, got blanks");
        _usable = false;
        return;
    }
    for (const std::string &cell : cells)
        read_column(cell, rules);
}

void CsvTable::read_column(const std::string &cell, const std::vector<CsvRule> &rules) {
    Heading heading = heading_of(cell);
    std::string &name = heading.name;
    std::optional<std::string> &unit = heading.unit;
    const CsvRule *rule = rule_named(name, rules);
    if (!rule && !unit)
        if (const CsvRule *meant = rule_of_unit(name, rules)) {
            rule = meant;
            unit = name;
            name = rule->name;
        }
    Column column;
    column.name = name;
    const auto refuse_it = [&](const std::string &text) { refuse(_header_line, name, text); };
    if (!rule) {
        std::vector<std::string> names;
        for (const CsvRule &known : rules)
            names.push_back(known.name);
        refuse_it(name.empty() ? "expected the name of the column, got none"
                               : "unknown column" + suggestion(name, names));
    } else if (has(name)) {
        refuse_it("expected each column once, got it twice");
    } else {
        column.quantity = rule->quantity;
    }
    if (column.quantity && unit) {
        const ColumnUnit own = column_unit(*unit, *column.quantity);
        const auto factor = unit_factor(own.unit, *column.quantity);
        if (factor)
            column.take(*factor * own.amplitude.value_or(1), own.amplitude.has_value());
        else
            refuse_it(fmt::format("expected a unit of {} in the header, got {}{}",
                                  describe(*column.quantity), in_quotes(*unit),
                                  unit_hint(*unit, *column.quantity)));
    } else if (rule && !rule->quantity && unit) {
        refuse_it("expected no unit in the header, got " + in_quotes(*unit));
    }
    _columns.push_back(column);
}

bool CsvTable::read_units(const Line &line) {
    if (line.cells.size() < _columns.size() || !_usable)
        return false;
    std::vector<std::optional<ColumnUnit>> units(_columns.size());
    bool any = false;
    for (std::size_t i = 0; i < _columns.size(); ++i) {
        std::string_view unit = line.cells[i];
        if (unit.size() > 2 && (unit.starts_with('[') || unit.starts_with('(')))
            unit = unit.substr(1, unit.size() - 2);
        if (unit.empty() || unit == "-")
            continue;
        if (!_columns[i].quantity || _columns[i].unit)
            return false;
        units[i] = column_unit(unit, *_columns[i].quantity);
        if (!unit_factor(units[i]->unit, *_columns[i].quantity))
            return false;
        any = true;
    }
    for (std::size_t i = 0; i < _columns.size(); ++i)
        if (units[i])
            _columns[i].take(*unit_factor(units[i]->unit, *_columns[i].quantity) *
                                 units[i]->amplitude.value_or(1),
                             units[i]->amplitude.has_value());
    return any;
}

void CsvTable::Column::take(double unit_factor, bool says_reading) {
    factor = unit_factor;
    unit = true;
    reading = says_reading;
}

void CsvTable::add_line(Line line) {
    std::vector<std::string> &cells = line.cells;
    if (std::ranges::all_of(cells, &std::string::empty))
        return;
    while (cells.size() > _columns.size() && cells.back().empty())
        cells.pop_back();
    if (cells.size() == _columns.size()) {
        _lines.push_back(std::move(line));
        return;
    }
    refuse(
        line.number, "",
        fmt::format("expected {} cells as in the header, got {}{}", _columns.size(), cells.size(),
                    cells.size() > _columns.size() ? "; is one a decimal comma? write 0.5, not 0,5"
                                                   : ""));
}

void CsvTable::read_decimal_commas(char separator) {
    struct Found {
        const Line *line = nullptr;
        const Column *column = nullptr;
    };
    Found comma, point, sure_comma, sure_point;
    const auto each_number = [&](const auto &visit) {
        for (Line &line : _lines)
            for (const Column &column : _columns)
                if (column.quantity)
                    visit(line, column,
                          line.cells[static_cast<std::size_t>(&column - _columns.data())]);
    };
    each_number([&](const Line &line, const Column &column, const std::string &cell) {
        const Digits digits = digits_of(cell);
        if (digits.commas + digits.points != 1)
            return; // refused where it is read, if it is none
        const bool is_comma = digits.commas == 1;
        (is_comma ? comma : point) = {&line, &column};
        if (!digits.grouped)
            (is_comma ? sure_comma : sure_point) = {&line, &column};
    });
    if (sure_comma.line && point.line) {
        refuse(sure_comma.line->number, sure_comma.column->name,
               fmt::format("expected one decimal sign in a table, got {} here and {} in {}",
                           in_quotes(cell(*sure_comma.line, *sure_comma.column)),
                           in_quotes(cell(*point.line, *point.column)),
                           place(*point.line, *point.column)));
    } else if (separator == ';' && !comma.line && point.line && !sure_point.line) {
        const std::string &text = cell(*point.line, *point.column);
        std::string digits = text;
        std::erase(digits, '.');
        refuse(point.line->number, point.column->name,
               fmt::format("expected a number whose point is a decimal one or none, got {}, which "
                           "is a thousand times larger where semicolons part the columns; write "
                           "\"{}\" or \"{}0\"",
                           in_quotes(text), digits, text));
    } else if (comma.line && !point.line && (sure_comma.line || separator == ';')) {
        each_number([](const Line &, const Column &, std::string &cell) {
            if (const Digits digits = digits_of(cell); digits.commas == 1 && digits.points == 0)
                cell[digits.comma] = '.';
        });
    }
}

const CsvTable::Column *CsvTable::find(const std::string &name) const {
    const auto found = std::ranges::find(_columns, name, &Column::name);
    return found == _columns.end() ? nullptr : &*found;
}

const std::string &CsvTable::cell(const Line &line, const Column &column) const {
    return line.cells[static_cast<std::size_t>(&column - _columns.data())];
}

std::string CsvTable::place(const Line &line, const Column &column) const {
    std::string letters;
    for (auto i = &column - _columns.data() + 1; i > 0; i = (i - 1) / 26)
        letters.insert(letters.begin(), static_cast<char>('A' + (i - 1) % 26));
    return fmt::format("{}{}", letters, line.number);
}

bool CsvTable::has_unit(const std::string &column) const {
    const Column *found = find(column);
    return found && (found->unit || std::ranges::none_of(_lines, [&](const Line &line) {
                         return parse_number(cell(line, *found)).has_value();
                     }));
}

bool CsvTable::says_reading(const std::string &column) const {
    const Column *found = find(column);
    return found && found->reading;
}

void CsvTable::fail(const std::string &column, std::string text) const {
    _problems->add({_file, _header_line}, column, std::move(text));
}

std::vector<CsvRow> CsvTable::rows() const {
    std::vector<CsvRow> rows;
    for (const Line &line : _lines)
        rows.emplace_back(*this, line);
    return rows;
}

std::optional<std::string> CsvRow::text(const std::string &column) const {
    const CsvTable::Column *found = _table->find(column);
    if (!found || _table->cell(*_line, *found).empty())
        return std::nullopt;
    return _table->cell(*_line, *found);
}

double CsvRow::number(const std::string &column, Quantity quantity, Range range) const {
    const auto cell = text(column);
    // A plain number has the unit of the header; one with a unit is in SI when it is parsed.
    std::optional<double> value = parse_number(cell.value_or(""));
    if (value)
        value = scaled(*value, _table->find(column)->factor);
    else if (cell)
        value = parse_quantity(*cell, quantity);
    if (value && std::isfinite(*value) && range.contains(*value))
        return *value;
    const auto place = [&] { return _table->place(*_line, *_table->find(column)); };
    std::string got = cell ? in_quotes(*cell) + quantity_hint(*cell, quantity) : "an empty cell";
    if (value)
        got += range.otherwise;
    if (cell && is_spreadsheet_error(*cell))
        got = fmt::format("{} (cell {})", told(*cell), place());
    else if (cell && is_too_narrow(*cell))
        got = fmt::format("{}: the column of the spreadsheet was too narrow for the number (cell "
                          "{})",
                          in_quotes(*cell), place());
    fail(column, fmt::format("expected {}{}, got {}", describe(quantity), range.words(), got));
    return std::numeric_limits<double>::quiet_NaN();
}

std::optional<double> CsvRow::optional_number(const std::string &column, Quantity quantity,
                                              Range range) const {
    return text(column) ? std::optional(number(column, quantity, range)) : std::nullopt;
}

int CsvRow::whole_or(const std::string &column, int fallback, int low, int high) const {
    const double least = low;
    const auto number =
        optional_number(column, Quantity::number, {least, static_cast<double>(high)});
    if (!number)
        return fallback;
    const int whole = static_cast<int>(std::max(least, *number)); // the least of nan
    if (whole < *number)
        fail(column, fmt::format("expected a whole number, got {}", *number));
    return whole;
}

void CsvRow::fail(const std::string &column, std::string text) const {
    _table->_problems->add({_table->_file, _line->number}, column, std::move(text));
}

} // namespace whirl::input
