#pragma once

#include "report/common/table.h"

namespace whirl::report {

/// A value for a CSV file: numbers with all digits, empty for what is missing or not finite, text
/// in quotes where it could break the row. A text that a spreadsheet would take for a formula, such
/// as "=A1", has an apostrophe in front (OWASP, "CSV injection").
/// @param factor  of numbers, from csv_factors()
[[nodiscard]] std::string csv_cell(const Json &value, double factor = 1);
/// The first line of a file, its units, in brackets at the ends of headings, those asked for: the
/// numbers below are converted with csv_factors(), as csv_rows() does.
[[nodiscard]] std::string csv_head_line(const std::vector<std::string> &head);
/// What the numbers below the headings are multiplied by for these.
[[nodiscard]] std::vector<double> csv_factors(const std::vector<std::string> &head);
/// Cells with commas between and a line end.
[[nodiscard]] std::string csv_line(const std::vector<std::string> &cells);

/// The headings in a file.
template <class Row> [[nodiscard]] std::vector<std::string> csv_head(const Columns<Row> &columns) {
    std::vector<std::string> head;
    for (const Column<Row> &column : columns)
        if (!column.csv.empty())
            head.push_back(column.csv);
    return head;
}
/// Lines of a file with this head, which may hold several kinds of rows: cells for which this kind
/// has no column stay empty.
template <class Row, class Rows>
[[nodiscard]] std::string csv_rows(const std::vector<std::string> &head,
                                   const Columns<Row> &columns, const Rows &rows) {
    const std::vector<double> factors = csv_factors(head);
    std::string text;
    for (std::size_t index = 0; const Row &row : rows) {
        std::vector<std::string> cells(head.size());
        for (const Column<Row> &column : columns)
            for (std::size_t i = 0; i < head.size() && !column.csv.empty(); ++i)
                if (head[i] == column.csv)
                    cells[i] = csv_cell(column.value(row, index), factors[i]);
        text += csv_line(cells);
        ++index;
    }
    return text;
}
template <class Row, class Rows>
[[nodiscard]] std::string csv_table(const Columns<Row> &columns, const Rows &rows) {
    const std::vector<std::string> head = csv_head(columns);
    return csv_head_line(head) + csv_rows(head, columns, rows);
}
/// A file of lists, each below its heading; cells beyond the end of one that is shorter than the
/// first stay empty.
[[nodiscard]] std::string csv_lists(const std::vector<std::pair<std::string, Json>> &lists);

} // namespace whirl::report
