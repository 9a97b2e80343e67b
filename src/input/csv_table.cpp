#include "input/csv_table.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <fstream>

namespace whirl::input {
namespace {

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

struct Cells {
    std::vector<std::string> cells;
    const char *mistake = nullptr; ///< what is wrong with its quotation marks
};

/// Cells of a line without white space and quotation marks around them, up to a comment.
Cells split(std::string_view rest) {
    Cells line;
    while (true) {
        rest = trimmed(rest);
        if (rest.starts_with('"')) {
            const std::optional<std::string> cell = take_quoted(rest);
            if (!cell)
                return {{}, "expected a quotation mark at the end of a cell that starts with one"};
            line.cells.push_back(*cell);
            rest = trimmed(rest);
            if (!rest.empty() && !rest.starts_with(',') && !rest.starts_with('#'))
                return {{}, "expected a comma after the quotation mark that ends a cell"};
        } else {
            const std::size_t end = std::min(rest.find_first_of(",#"), rest.size());
            line.cells.emplace_back(trimmed(rest.substr(0, end)));
            rest.remove_prefix(end);
        }
        if (!rest.starts_with(','))
            return line;
        rest.remove_prefix(1);
    }
}

} // namespace

CsvTable::CsvTable(const std::filesystem::path &file, const std::vector<CsvRule> &rules,
                   Problems &problems)
    : _problems(&problems), _file(file.generic_string()) {
    std::ifstream stream(file);
    if (std::filesystem::is_directory(file) || !stream) {
        problems.add({_file, 0}, "", "expected a CSV table, the file cannot be read");
        return;
    }
    std::string line;
    bool header = true;
    for (int number = 1; std::getline(stream, line); ++number) {
        std::string_view content = line;
        if (number == 1 && content.starts_with("\xEF\xBB\xBF")) // byte order mark of spreadsheets
            content.remove_prefix(3);
        content = trimmed(content);
        if (content.empty() || content.starts_with('#'))
            continue;
        auto [cells, mistake] = split(content);
        if (mistake) {
            problems.add({_file, number}, "", mistake);
            _usable = false;
            if (header)
                return;
        } else if (header && cells.size() == 1 && cells.front().find(';') != std::string::npos) {
            problems.add({_file, number}, "",
                         "expected commas between the columns, got semicolons");
            return;
        } else if (header) {
            header = false;
            _header_line = number;
            _usable = true;
            for (const std::string &cell : cells)
                read_column(cell, rules);
        } else if (cells.size() != _columns.size()) {
            problems.add({_file, number}, "",
                         fmt::format("expected {} cells as in the header, got {}{}",
                                     _columns.size(), cells.size(),
                                     cells.size() > _columns.size()
                                         ? "; is one a decimal comma? write 0.5, not 0,5"
                                         : ""));
            _usable = false;
        } else {
            _lines.push_back({number, std::move(cells)});
        }
    }
    if (header)
        fail("", "expected a header line, the table is empty");
    else if (_usable && _lines.empty())
        fail("", "expected rows below the header, there are none");
    _usable = _usable && !_lines.empty();
}

void CsvTable::read_column(const std::string &cell, const std::vector<CsvRule> &rules) {
    const std::size_t bracket = std::min(cell.find('['), cell.size());
    Column column;
    column.name = trimmed(std::string_view(cell).substr(0, bracket));
    const auto refuse = [&](const std::string &text) {
        fail(column.name, text);
        _usable = false;
    };
    const auto rule = std::ranges::find(rules, column.name, &CsvRule::name);
    if (rule == rules.end()) {
        std::vector<std::string> names;
        for (const CsvRule &known : rules)
            names.push_back(known.name);
        refuse("unknown column" + suggestion(column.name, names));
    } else if (has(column.name)) {
        refuse("expected each column once, got it twice");
    } else if (bracket < cell.size()) {
        std::string_view unit = std::string_view(cell).substr(bracket + 1);
        unit = unit.substr(0, unit.find(']'));
        const auto factor =
            rule->quantity ? unit_factor(unit, *rule->quantity) : std::optional<double>();
        column.unit = factor.has_value();
        column.factor = factor.value_or(1);
        if (!factor)
            refuse(
                fmt::format("expected {} in the header, got {}",
                            rule->quantity ? "a unit of " + describe(*rule->quantity) : "no unit",
                            in_quotes(unit)));
    }
    _columns.push_back(column);
}

const CsvTable::Column *CsvTable::find(const std::string &name) const {
    const auto found = std::ranges::find(_columns, name, &Column::name);
    return found == _columns.end() ? nullptr : &*found;
}

const std::string &CsvTable::cell(const Line &line, const Column &column) const {
    return line.cells[static_cast<std::size_t>(&column - _columns.data())];
}

bool CsvTable::has_unit(const std::string &column) const {
    const Column *found = find(column);
    return found && (found->unit || std::ranges::none_of(_lines, [&](const Line &line) {
                         return parse_number(cell(line, *found)).has_value();
                     }));
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
    fail(column, fmt::format("expected {}{}, got {}", describe(quantity), range.words(),
                             cell ? in_quotes(*cell) : "an empty cell"));
    return std::numeric_limits<double>::quiet_NaN();
}

std::optional<double> CsvRow::optional_number(const std::string &column, Quantity quantity,
                                              Range range) const {
    return text(column) ? std::optional(number(column, quantity, range)) : std::nullopt;
}

int CsvRow::whole_or(const std::string &column, int fallback, int low, int high) const {
    const double least = low;
    const auto number =
        optional_number(column, Quantity::dimensionless, {least, static_cast<double>(high)});
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
