#pragma once

#include "report/common/table.h"

namespace whirl::report {

/// A value for a CSV file: numbers with all digits, empty for what is missing or not finite, text
/// in quotes where it could break the row. A text that a spreadsheet would take for a formula, such
/// as "=A1", has an apostrophe in front (OWASP, "CSV injection").
[[nodiscard]] std::string csv_cell(const Json &value);
/// Cells with commas between and a line end.
[[nodiscard]] std::string csv_line(const std::vector<std::string> &cells);

/// A heading of a file, without its unit.
struct CsvHeading {
    std::string name;
    Quantity quantity = Quantity::number;
    bool operator==(const CsvHeading &) const = default;
};
/// The first line of a file: headings with their units in brackets.
[[nodiscard]] std::string csv_head_line(const std::vector<CsvHeading> &head, const Units &units);

/// The headings in a file.
template <class Row> [[nodiscard]] std::vector<CsvHeading> csv_head(const Columns<Row> &columns) {
    std::vector<CsvHeading> head;
    for (const Column<Row> &column : columns)
        if (!column.csv.empty())
            head.push_back({column.csv, column.quantity});
    return head;
}
/// Lines of a file with this head, which may hold several kinds of rows: cells for which this kind
/// has no column stay empty.
template <class Row, class Rows>
[[nodiscard]] std::string csv_rows(const std::vector<CsvHeading> &head, const Columns<Row> &columns,
                                   const Rows &rows, const Units &units) {
    std::string text;
    for (std::size_t index = 0; const Row &row : rows) {
        std::vector<std::string> cells(head.size());
        for (const Column<Row> &column : columns)
            for (std::size_t i = 0; i < head.size() && !column.csv.empty(); ++i)
                if (head[i] == CsvHeading{column.csv, column.quantity})
                    cells[i] = csv_cell(column.written(row, index, units));
        text += csv_line(cells);
        ++index;
    }
    return text;
}
template <class Row, class Rows>
[[nodiscard]] std::string csv_table(const Columns<Row> &columns, const Rows &rows,
                                    const Units &units) {
    const std::vector<CsvHeading> head = csv_head(columns);
    return csv_head_line(head, units) + csv_rows(head, columns, rows, units);
}

/// A list below its heading.
struct CsvList {
    CsvHeading heading;
    Json values; ///< in SI
};
/// A file of lists; cells beyond the end of one that is shorter than the first stay empty.
[[nodiscard]] std::string csv_lists(const std::vector<CsvList> &lists, const Units &units);

} // namespace whirl::report
