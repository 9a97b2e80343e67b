#pragma once

#include "input/checked_table.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace whirl::input {

/// A column that a CSV table may have; `quantity` is empty for columns of text.
struct CsvRule {
    std::string name;
    std::optional<Quantity> quantity;
};

/// A table of numbers with a header line. Header cells may carry a unit ("length [mm]") that holds
/// for the plain numbers below it, cells may carry their own ("25 mm"). A cell in
/// quotation marks may hold commas and '#', and "" for one of them. Blank lines and what else
/// follows '#' are skipped. Mistakes are collected as "file:line: column: text".
class CsvTable {
  public:
    /// Reads the file; its header may have the columns of `rules`, each once, in any order.
    /// `file` must be reachable from the working directory and names the table in messages.
    CsvTable(const std::filesystem::path &file, const std::vector<CsvRule> &rules,
             Problems &problems);

    /// False where the file or its header was wrong or it has no rows; the problem is collected.
    [[nodiscard]] bool usable() const { return _usable; }
    [[nodiscard]] std::size_t rows() const { return _rows.size(); }
    [[nodiscard]] bool has(const std::string &column) const { return find(column) != nullptr; }
    /// Whether the header of the column or all its cells say in which unit they are.
    [[nodiscard]] bool has_unit(const std::string &column) const;
    [[nodiscard]] Origin origin(std::size_t row) const { return {_file, _rows[row].line}; }
    [[nodiscard]] Origin header_origin() const { return {_file, _header_line}; }

    /// Text of a cell; empty where the column is missing.
    [[nodiscard]] std::string text(std::size_t row, const std::string &column) const;
    /// Number of a cell in SI; nan and a problem where it is missing, wrong or out of range.
    double number(std::size_t row, const std::string &column, Range range);
    /// The same, but empty where the cell or the whole column is.
    std::optional<double> optional_number(std::size_t row, const std::string &column, Range range);

  private:
    struct Column {
        std::string name;
        std::optional<Quantity> quantity;
        double factor = 1; ///< of its unit to SI
        bool unit = false; ///< given in the header
        std::size_t index = 0;
    };
    struct Row {
        int line = 0;
        std::vector<std::string> cells;
    };

    void read_header(const std::vector<std::string> &cells, const std::vector<CsvRule> &rules);
    void read_column(const std::string &cell, std::size_t index, const std::vector<CsvRule> &rules);
    [[nodiscard]] const Column *find(const std::string &name) const;

    Problems *_problems;
    std::string _file;
    int _header_line = 1;
    std::vector<Column> _columns;
    std::vector<Row> _rows;
    bool _usable = false;
};

} // namespace whirl::input
