#pragma once

#include "report/common/column.h"

#include <span>
#include <string>
#include <vector>

namespace whirl::report {

/// A table of texts, heading first.
using Texts = std::vector<std::vector<std::string>>;

/// A value for readers: `missing` for what is null or not a number.
[[nodiscard]] std::string shown(const Json &value, const Shown &as, const std::string &missing);
/// HTML; cells are escaped here.
[[nodiscard]] std::string page_table(const Texts &table);
/// Columns as wide as their widest entry: the first to the left, the others to the right.
[[nodiscard]] std::string text_table(const Texts &table);

/// A column as one reader sees it.
struct ShownColumn {
    Shown as;
    std::string context; ///< further words that tell what its numbers are
    std::vector<Json> values;
};
/// Headings and cells in the units that were asked for; of two columns that are the same in these,
/// as rpm and rad/s, the first.
[[nodiscard]] Texts texts_of(const std::vector<ShownColumn> &columns, const std::string &missing);

/// The columns that a reader sees. @param reader  &Column<Row>::page or &Column<Row>::text
template <class Row, class Rows>
[[nodiscard]] Texts texts_of(const Columns<Row> &columns, const Rows &rows,
                             Shown Column<Row>::*reader, const std::string &missing) {
    std::vector<ShownColumn> all;
    for (const Column<Row> &column : columns) {
        if (!(column.*reader).heading)
            continue;
        all.push_back({column.*reader,
                       column.key + " " + column.csv + " " + column.page.heading.value_or(""),
                       {}});
        for (std::size_t index = 0; const Row &row : rows)
            all.back().values.push_back(column.value(row, index++));
    }
    return texts_of(all, missing);
}
template <class Row, class Rows>
[[nodiscard]] std::string page_table(const Columns<Row> &columns, const Rows &rows) {
    return page_table(texts_of(columns, rows, &Column<Row>::page, "–"));
}
template <class Row, class Rows>
[[nodiscard]] std::string text_table(const Columns<Row> &columns, const Rows &rows) {
    return text_table(texts_of(columns, rows, &Column<Row>::text, "-"));
}
/// The same below a heading; nothing without rows.
template <class Row, class Rows>
[[nodiscard]] std::string text_table(const std::string &heading, const Columns<Row> &columns,
                                     const Rows &rows) {
    return rows.empty() ? "" : heading + text_table(columns, rows);
}

/// What one row is, a line a column: headings in front of values.
template <class Row>
[[nodiscard]] Texts properties(const Columns<Row> &columns, const Row &row,
                               Shown Column<Row>::*reader, const std::string &missing) {
    const Texts table = texts_of(columns, std::span<const Row>(&row, 1), reader, missing);
    Texts lines;
    for (std::size_t i = 0; i < table[0].size(); ++i)
        lines.push_back({table[0][i], table[1][i]});
    return lines;
}
template <class Row>
[[nodiscard]] std::string page_properties(const Columns<Row> &columns, const Row &row) {
    Texts lines = properties(columns, row, &Column<Row>::page, "–");
    lines.insert(lines.begin(), {"Quantity", "Value"});
    return page_table(lines);
}

/// The row as an object.
template <class Row>
[[nodiscard]] Json json_row(const Columns<Row> &columns, const Row &row, std::size_t index = 0) {
    Json object = json_object(columns.size());
    for (const Column<Row> &column : columns)
        if (!column.key.empty())
            object[column.key] = column.value(row, index);
    return object;
}
/// The rows as a list of objects.
template <class Row, class Rows>
[[nodiscard]] Json json_rows(const Columns<Row> &columns, const Rows &rows) {
    Json items = Json::array();
    for (const Row &row : rows)
        items.push_back(json_row(columns, row, items.size()));
    return items;
}
/// The rows as one object whose entries are lists over them.
template <class Row, class Rows>
[[nodiscard]] Json json_lists(const Columns<Row> &columns, const Rows &rows) {
    Json object = json_object(columns.size());
    for (const Column<Row> &column : columns) {
        if (column.key.empty())
            continue;
        Json &list = object[column.key] = Json::array();
        for (const Row &row : rows)
            list.push_back(column.value(row, list.size()));
    }
    return object;
}

} // namespace whirl::report
