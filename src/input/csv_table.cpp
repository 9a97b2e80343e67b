#include "input/csv_table.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <fstream>

namespace whirl::input {
namespace {

/// Cells of a line without white space and quotation marks around them.
std::vector<std::string> split(std::string_view line) {
    std::vector<std::string> cells;
    while (true) {
        const std::size_t comma = std::min(line.find(','), line.size());
        std::string_view cell = trimmed(line.substr(0, comma));
        if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"')
            cell = trimmed(cell.substr(1, cell.size() - 2));
        cells.emplace_back(cell);
        if (comma == line.size())
            return cells;
        line.remove_prefix(comma + 1);
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
        content = trimmed(content.substr(0, content.find('#')));
        if (content.empty())
            continue;
        std::vector<std::string> cells = split(content);
        if (header) {
            header = false;
            _header_line = number;
            _usable = true;
            read_header(cells, rules);
        } else if (cells.size() != _columns.size()) {
            problems.add({_file, number}, "",
                         fmt::format("expected {} cells as in the header, got {}", _columns.size(),
                                     cells.size()));
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
    Column column{std::string(trimmed(std::string_view(cell).substr(0, bracket))), {}, 1, index};
    const auto fail = [&](const std::string &text) {
        _problems->add(header_origin(), column.name, text);
        _usable = false;
    };
    const auto rule = std::find_if(rules.begin(), rules.end(), [&](const CsvRule &candidate) {
        return candidate.name == column.name;
    });
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
    const auto found = std::find_if(_columns.begin(), _columns.end(),
                                    [&](const Column &column) { return column.name == name; });
    return found == _columns.end() ? nullptr : &*found;
}

std::string CsvTable::text(std::size_t row, const std::string &column) const {
    const Column *found = find(column);
    return found ? _rows[row].cells[found->index] : "";
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
