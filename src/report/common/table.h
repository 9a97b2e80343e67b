#pragma once

#include "report/common/column.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

namespace whirl::report {

/// A table of texts, heading first.
using Texts = std::vector<std::vector<std::string>>;

/// A value for readers: `missing` for what is null or not a number.
[[nodiscard]] std::string shown(const Json &value, const Shown &as, const std::string &missing);
/// The column as the terminal shows it.
[[nodiscard]] Shown for_terminal(Shown as, const TextStyle &style);
/// Whether an error changes the digits that are shown of a value, whatever its leading digit.
[[nodiscard]] bool above_digits(double error, double value, const TextStyle &style);
/// HTML; cells are escaped here.
[[nodiscard]] std::string page_table(const Texts &table);
/// "The first 12 of 40 rows."
[[nodiscard]] std::string rows_left_out(std::size_t shown, std::size_t all);
/// Rows of a table in a summary of several analyses: a page of each should be enough.
inline constexpr std::size_t brief_rows = 12;
/// Columns as wide as their widest entry: the first to the left, the others to the right.
[[nodiscard]] std::string text_table(const Texts &table);

/// Adds a column: its heading and its cells. @param values  as they are written
void add_column(Texts &table, const std::string &heading, const std::vector<Json> &values,
                const Shown &as, const std::string &missing);
/// A heading with its unit: "Spin speed (rpm)" on a page, "spin speed rpm" on the terminal.
[[nodiscard]] std::string heading_of(const Shown &column, const model::Unit &unit, bool on_page);

/// Whether a column of errors is left out on the terminal: where none was asked for and all are
/// below the digits shown. Errors with a unit are compared with the largest number of a row in that
/// unit, others are relative.
template <class Row, class Rows>
[[nodiscard]] bool left_out(const Column<Row> &errors, const Columns<Row> &columns,
                            const Rows &rows, const TextStyle &style) {
    if (errors.text.format != rough || style.errors)
        return false;
    for (std::size_t index = 0; const Row &row : rows) {
        const auto number = [&](const Column<Row> &column) {
            const Json value = column.value(row, index, {});
            return value.is_number() ? value.template get<double>() : 0.0;
        };
        const Quantity quantity = errors.of(row);
        double value = quantity == Quantity::number ? 1 : 0;
        for (const Column<Row> &column : columns)
            if (quantity != Quantity::number && column.text.heading && column.of(row) == quantity &&
                column.text.format != rough)
                value = std::max(value, std::abs(number(column)));
        if (above_digits(number(errors), value, style))
            return false;
        ++index;
    }
    return true;
}

/// Not null, not a number that is none and no empty text: of a column without any there is nothing
/// to be read.
[[nodiscard]] bool says_something(const Json &value);

/// The columns that a reader sees, but for those without an entry. @param reader &Column<Row>::page
/// or &Column<Row>::text
template <class Row, class Rows>
[[nodiscard]] Texts texts_of(const Columns<Row> &columns, const Rows &rows,
                             Shown Column<Row>::*reader, const std::string &missing,
                             const Units &units) {
    static const Units si;
    const bool on_page = reader == &Column<Row>::page;
    Texts table(1 + rows.size());
    for (const Column<Row> &column : columns) {
        Shown as = column.*reader;
        if (!as.heading || (!on_page && left_out(column, columns, rows, units.style())))
            continue;
        const auto add = [&](const Units &in) {
            std::vector<Json> values;
            for (std::size_t index = 0; const Row &row : rows)
                values.push_back(column.written(row, index++, in));
            if (!values.empty() && std::ranges::none_of(values, says_something))
                return;
            add_column(table, heading_of(as, in.unit(column.quantity), on_page), values,
                       on_page ? as : for_terminal(as, units.style()), missing);
        };
        // All digits are in SI, where they are asked for.
        const bool beside_si = !as.si_format.empty() && !units.asked(column.quantity) &&
                               (on_page || !units.style().few_digits());
        if (!as.si_format.empty() && !beside_si)
            as.format = as.si_format;
        add(units);
        as.format = as.si_format;
        if (beside_si)
            add(si);
    }
    return table;
}
template <class Row, class Rows>
[[nodiscard]] std::string page_table(const Columns<Row> &columns, const Rows &rows,
                                     const Units &units) {
    return page_table(texts_of(columns, rows, &Column<Row>::page, "–", units));
}
template <class Row, class Rows>
[[nodiscard]] std::string text_table(const Columns<Row> &columns, const Rows &rows,
                                     const Units &units) {
    return text_table(texts_of(columns, rows, &Column<Row>::text, "-", units));
}
/// The first rows on a page, and how many there are where these are not all.
template <class Row, class Rows>
[[nodiscard]] std::string page_table_of_first(std::size_t most, const Columns<Row> &columns,
                                              const Rows &rows, const Units &units) {
    if (rows.size() <= most)
        return page_table(columns, rows, units);
    const std::vector<Row> first(rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(most));
    return page_table(columns, first, units) + rows_left_out(most, rows.size());
}
/// The same below a heading; nothing without rows.
template <class Row, class Rows>
[[nodiscard]] std::string text_table(const std::string &heading, const Columns<Row> &columns,
                                     const Rows &rows, const Units &units) {
    return rows.empty() ? "" : heading + text_table(columns, rows, units);
}

/// What one row is, a line a column: headings in front of values with their units.
template <class Row>
[[nodiscard]] Texts properties(const Columns<Row> &columns, const Row &row,
                               Shown Column<Row>::*reader, const std::string &missing,
                               const Units &units) {
    Texts lines;
    const bool on_page = reader == &Column<Row>::page;
    for (const Column<Row> &column : columns) {
        const Shown as = on_page ? column.*reader : for_terminal(column.*reader, units.style());
        if (!as.heading ||
            (!on_page && left_out(column, columns, std::span(&row, 1), units.style())))
            continue;
        const Json value = column.written(row, 0, units);
        const std::string text = shown(value, as, missing);
        const std::string unit = units.name(column.of(row));
        const bool number = value.is_number() && std::isfinite(value.template get<double>());
        // Texts of a quantity are numbers in its unit: "3 … 4".
        const bool numbers = number || (value.is_string() && text != missing && !text.empty());
        lines.push_back({*as.heading, numbers && !unit.empty() ? text + " " + unit : text});
    }
    return lines;
}
template <class Row>
[[nodiscard]] std::string page_properties(const Columns<Row> &columns, const Row &row,
                                          const Units &units) {
    Texts lines = properties(columns, row, &Column<Row>::page, "–", units);
    lines.insert(lines.begin(), {"Quantity", "Value"});
    return page_table(lines);
}

/// The row as an object.
template <class Row>
[[nodiscard]] Json json_row(const Columns<Row> &columns, const Row &row, const Units &units,
                            std::size_t index = 0) {
    Json object = json_object(columns.size());
    for (const Column<Row> &column : columns)
        if (!column.key.empty())
            object[column.key] = column.written(row, index, units);
    return object;
}
/// The rows as a list of objects.
template <class Row, class Rows>
[[nodiscard]] Json json_rows(const Columns<Row> &columns, const Rows &rows, const Units &units) {
    Json items = Json::array();
    for (const Row &row : rows)
        items.push_back(json_row(columns, row, units, items.size()));
    return items;
}
/// The rows as one object whose entries are lists over them.
template <class Row, class Rows>
[[nodiscard]] Json json_lists(const Columns<Row> &columns, const Rows &rows, const Units &units) {
    Json object = json_object(columns.size());
    for (const Column<Row> &column : columns) {
        if (column.key.empty())
            continue;
        Json &list = object[column.key] = Json::array();
        for (const Row &row : rows)
            list.push_back(column.written(row, list.size(), units));
    }
    return object;
}

} // namespace whirl::report
