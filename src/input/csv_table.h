#pragma once

#include "input/checked_table.h"

#include <optional>
#include <string>
#include <vector>

namespace whirl::input {

/// A column that a CSV table may have; `quantity` is empty for columns of text.
struct CsvRule {
    std::string name;
    std::optional<Quantity> quantity;
};

class CsvRow;

/// A table of numbers with a header line, as people and spreadsheets write them: columns apart by
/// commas, semicolons or tabs; with semicolons and tabs a decimal comma; lines ended in any way, in
/// UTF-8, UTF-16 or the Windows code page, with empty cells behind the last column.
///
/// Header cells may carry a unit ("length [mm]") that holds for the plain numbers below it, or be
/// one that fits a single column ("rpm"); a line of units may follow; cells may carry their own
/// ("25 mm"). A cell in quotation marks may hold separators and '#', and "" for one of them. Blank
/// lines and what else follows '#' are skipped, but for the errors of a spreadsheet (#DIV/0!). What
/// has two meanings, as 1,234 without another sign of what its comma is, is refused. Mistakes are
/// collected as "file:line: column: text".
class CsvTable {
  public:
    /// Reads the file that an entry of the case names; its header may have the columns of `rules`,
    /// each once, in any order. Where there is no such file, that is a mistake of the entry.
    CsvTable(const CheckedEntry &asked, const std::vector<CsvRule> &rules);

    /// False where the file or its header was wrong or it has no rows; the problem is collected.
    [[nodiscard]] bool usable() const { return _usable; }
    /// Rows below the header; the table must outlive them.
    [[nodiscard]] std::vector<CsvRow> rows() const;
    [[nodiscard]] bool has(const std::string &column) const { return find(column) != nullptr; }
    /// Whether the header of the column or all its cells say in which unit they are.
    [[nodiscard]] bool has_unit(const std::string &column) const;
    /// Whether its unit says how a vibration is read, as in "um pk-pk" or "mil rms": what stands in
    /// the column is then read as amplitudes.
    [[nodiscard]] bool says_reading(const std::string &column) const;
    /// Collects a mistake at the header.
    void fail(const std::string &column, std::string text) const;

  private:
    friend CsvRow;
    struct Column {
        std::string name;
        std::optional<Quantity> quantity;
        double factor = 1;    ///< of its unit to SI
        bool unit = false;    ///< given in the header
        bool reading = false; ///< how a vibration is read is given there too
        void take(double unit_factor, bool says_reading);
    };
    struct Line {
        int number = 0;
        std::vector<std::string> cells;
    };

    void read(std::string_view text, const std::vector<CsvRule> &rules);
    void read_header(const Line &line, const std::vector<CsvRule> &rules);
    void read_column(const std::string &cell, const std::vector<CsvRule> &rules);
    /// Takes the line as one of units below the names. @returns whether it is one
    bool read_units(const Line &line);
    void add_line(Line line);
    /// Makes points of decimal commas, or refuses where it is not known what commas are.
    void read_decimal_commas(char separator);
    void refuse(int line, const std::string &column, std::string text);
    [[nodiscard]] const Column *find(const std::string &name) const;
    /// Of the line; the table must have the column.
    [[nodiscard]] const std::string &cell(const Line &line, const Column &column) const;
    /// "B7", as a spreadsheet names it.
    [[nodiscard]] std::string place(const Line &line, const Column &column) const;

    Problems *_problems;
    std::string _file;
    int _header_line = 1;
    std::vector<Column> _columns;
    std::vector<Line> _lines;
    bool _usable = false;
};

/// A row, read as a CheckedTable is: its entries are the cells that are not empty.
class CsvRow {
  public:
    CsvRow(const CsvTable &table, const CsvTable::Line &line) : _table(&table), _line(&line) {}

    [[nodiscard]] std::optional<std::string> text(const std::string &column) const;
    /// In SI; nan and a problem where it is missing, wrong or out of range.
    [[nodiscard]] double number(const std::string &column, Quantity quantity,
                                Range range = {}) const;
    [[nodiscard]] std::optional<double> optional_number(const std::string &column,
                                                        Quantity quantity, Range range = {}) const;
    [[nodiscard]] double number_or(const std::string &column, double fallback, Quantity quantity,
                                   Range range = {}) const {
        return optional_number(column, quantity, range).value_or(fallback);
    }
    [[nodiscard]] int whole_or(const std::string &column, int fallback, int low, int high) const;
    void fail(const std::string &column, std::string text) const;
    /// Of the file, from 1.
    [[nodiscard]] int line() const { return _line->number; }

  private:
    const CsvTable *_table;
    const CsvTable::Line *_line;
};

} // namespace whirl::input
