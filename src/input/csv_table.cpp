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

struct Line {
    std::vector<std::string> cells;
    const char *mistake = nullptr; ///< what is wrong with its quotation marks
};

/// Cells of a line without white space and quotation marks around them, up to a comment.
Line split(std::string_view rest) {
    Line line;
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
            read_header(cells, rules);
        } else if (cells.size() != _columns.size()) {
            problems.add({_file, number}, "",
                         fmt::format("expected {} cells as in the header, got {}{}",
                                     _columns.size(), cells.size(),
                                     cells.size() > _columns.size()
                                         ? "; is one a decimal comma? write 0.5, not 0,5"
                                         : ""));
            _usable = false;
        } else {
            _rows.push_back({number, std::move(cells)});
        }
    }
    if (header)
        problems.add(header_origin(), "", "expected a header line, the table is empty");
    else if (_usable && _rows.empty())
        problems.add(header_origin(), "", "expected rows below the header, there are none");
    _usable = _usable && !_rows.empty();
}

void CsvTable::read_header(const std::vector<std::string> &cells,
                           const std::vector<CsvRule> &rules) {
    for (std::size_t i = 0; i < cells.size(); ++i)
        read_column(cells[i], i, rules);
}

void CsvTable::read_column(const std::string &cell, std::size_t index,
                           const std::vector<CsvRule> &rules) {
    const std::size_t bracket = std::min(cell.find('['), cell.size());
    Column column;
    column.name = trimmed(std::string_view(cell).substr(0, bracket));
    column.index = index;
    const auto fail = [&](const std::string &text) {
        _problems->add(header_origin(), column.name, text);
        _usable = false;
    };
    const auto rule = std::ranges::find(rules, column.name, &CsvRule::name);
    if (rule == rules.end()) {
        std::vector<std::string> names;
        for (const CsvRule &known : rules)
            names.push_back(known.name);
        fail("unknown column" + suggestion(column.name, names));
    } else if (has(column.name)) {
        fail("expected each column once, got it twice");
    } else if (bracket < cell.size()) {
        column.quantity = rule->quantity;
        std::string_view unit = std::string_view(cell).substr(bracket + 1);
        unit = unit.substr(0, unit.find(']'));
        const auto factor =
            rule->quantity ? unit_factor(unit, *rule->quantity) : std::optional<double>();
        column.unit = factor.has_value();
        if (factor)
            column.factor = *factor;
        else
            fail(fmt::format("expected {} in the header, got {}",
                             rule->quantity ? "a unit of " + describe(*rule->quantity) : "no unit",
                             in_quotes(unit)));
    } else {
        column.quantity = rule->quantity;
    }
    _columns.push_back(column);
}

const CsvTable::Column *CsvTable::find(const std::string &name) const {
    const auto found = std::ranges::find(_columns, name, &Column::name);
    return found == _columns.end() ? nullptr : &*found;
}

std::string CsvTable::text(std::size_t row, const std::string &column) const {
    const Column *found = find(column);
    return found ? _rows[row].cells[found->index] : "";
}

bool CsvTable::has_unit(const std::string &column) const {
    const Column *found = find(column);
    return found && (found->unit || std::ranges::none_of(_rows, [&](const Row &row) {
                         return parse_number(row.cells[found->index]).has_value();
                     }));
}

double CsvTable::number(std::size_t row, const std::string &column, Range range) {
    const Column *found = find(column);
    const Quantity quantity = found && found->quantity ? *found->quantity : Quantity::dimensionless;
    const std::string cell = text(row, column);
    // A plain number has the unit of the header; one with a unit is in SI when it is parsed.
    std::optional<double> value = parse_number(cell);
    if (value)
        value = scaled(*value, found->factor);
    else
        value = parse_quantity(cell, quantity);
    if (value && std::isfinite(*value) && range.contains(*value))
        return *value;
    _problems->add(origin(row), column,
                   fmt::format("expected {}{}, got {}", describe(quantity), range.words(),
                               cell.empty() ? "an empty cell" : in_quotes(cell)));
    return std::numeric_limits<double>::quiet_NaN();
}

std::optional<double> CsvTable::optional_number(std::size_t row, const std::string &column,
                                                Range range) {
    if (text(row, column).empty())
        return std::nullopt;
    return number(row, column, range);
}

} // namespace whirl::input
