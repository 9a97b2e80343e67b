#include "report/common/fitted_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

namespace whirl::report {

namespace {

/// Lines of a text that go together: a table with the lines in front of it, or lines alone.
struct Paragraph {
    std::vector<std::string> head; ///< in front of the table
    std::vector<std::string> table;
    std::size_t rows = 0; ///< of the table that are shown, with its head
    bool shown = true;

    [[nodiscard]] int height() const {
        return shown ? static_cast<int>(head.size() + rows + (rows < table.size() ? 1 : 0)) : 0;
    }
};

std::vector<Paragraph> paragraphs_of(const std::string &text) {
    std::vector<Paragraph> all(1);
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) {
        if (line.starts_with("  ")) {
            all.back().table.push_back(line);
            continue;
        }
        if (!all.back().table.empty())
            all.emplace_back();
        all.back().head.push_back(line);
    }
    for (Paragraph &one : all)
        one.rows = one.table.size();
    return all;
}

int height_of(const std::vector<Paragraph> &all) {
    int sum = 0;
    bool hidden = false; // which a line says
    for (const Paragraph &one : all) {
        sum += one.height();
        hidden = hidden || !one.shown;
    }
    return sum + (hidden ? 1 : 0);
}

/// In the order in which they stand, tables get a place with their first rows, as long as there is
/// one; then the first gets more rows, then the others, until the lines are full.
void fit(std::vector<Paragraph> &all, int lines) {
    constexpr std::size_t least = 3;          // the head and two rows
    constexpr std::size_t least_of_first = 5; // it is the answer
    constexpr std::size_t enough_of_first = 9;
    const auto fits = [&] { return height_of(all) <= lines; };
    if (fits())
        return;
    const auto first = std::ranges::find_if(all, [](const auto &at) { return !at.table.empty(); });
    // A line that says that one row is left out saves nothing.
    const auto rows_of = [](const Paragraph &one, std::size_t most) {
        return one.table.size() <= most + 1 ? one.table.size() : most;
    };
    for (auto one = first; one != all.end(); ++one) {
        one->rows = rows_of(*one, one == first ? least_of_first : least);
        one->shown = one == first || one->table.empty();
    }
    if (!fits() && first != all.end())
        first->rows = rows_of(*first, least);
    for (Paragraph &one : all) {
        const bool before = one.shown;
        one.shown = true;
        if (before || fits())
            continue;
        one.shown = false; // and what comes after it is worth less
        break;
    }
    const auto grow = [&](Paragraph &one, std::size_t most) {
        for (std::size_t rows = one.rows; one.shown && rows < most;) {
            const std::size_t before = one.rows;
            one.rows = rows_of(one, ++rows);
            if (!fits()) {
                one.rows = before;
                return;
            }
        }
    };
    if (first == all.end())
        return;
    grow(*first, enough_of_first);
    for (Paragraph &one : all)
        grow(one, one.table.size());
}

} // namespace

std::string fitted_text(const std::string &body, const std::vector<std::string> &notes,
                        const std::string &last, int lines) {
    std::vector<Paragraph> all = paragraphs_of(body);
    std::size_t told = notes.size();
    if (lines > 0) {
        const int room =
            lines - (last.empty() ? 0 : 1 + static_cast<int>(std::ranges::count(last, '\n')));
        constexpr int fair = 4; // notes have so many lines at least, the worst are first
        fit(all, std::max(room - static_cast<int>(notes.size()), room - fair));
        const int left = room - height_of(all);
        if (static_cast<int>(notes.size()) > left)
            told = static_cast<std::size_t>(std::max(left - 1, 1));
    }
    std::string text;
    std::size_t tables = 0;
    for (const Paragraph &one : all) {
        if (!one.shown) {
            ++tables;
            continue;
        }
        for (const std::string &line : one.head)
            text += line + "\n";
        for (std::size_t i = 0; i < one.rows; ++i)
            text += one.table[i] + "\n";
        if (one.rows < one.table.size())
            text += fmt::format("  … {} more rows\n", one.table.size() - one.rows);
    }
    if (tables > 0)
        text += fmt::format("… {} more {}\n", tables, tables == 1 ? "table" : "tables");
    for (std::size_t i = 0; i < told; ++i)
        text += notes[i] + "\n";
    if (told < notes.size())
        text += fmt::format("note: {} more\n", notes.size() - told);
    return last.empty() ? text : text + last + "\n";
}

} // namespace whirl::report
