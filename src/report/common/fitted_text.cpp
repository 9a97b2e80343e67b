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

/// Tables from the last one on lose rows, then go altogether; the first keeps more of its rows, and
/// loses them last.
void fit(std::vector<Paragraph> &all, int lines) {
    constexpr std::size_t least = 3; // the head and two rows
    constexpr std::size_t least_of_first = 9;
    const auto too_many = [&] { return height_of(all) - lines; };
    const auto cut = [&](Paragraph &one, std::size_t to) {
        if (too_many() <= 0 || one.rows <= to + 1) // a line for one row saves nothing
            return;
        // One more for the line that says so, where there is none yet.
        const auto spare =
            static_cast<std::size_t>(too_many()) + (one.rows == one.table.size() ? 1 : 0);
        one.rows = one.rows > to + spare ? one.rows - spare : to;
    };
    const auto first = std::ranges::find_if(all, [](const auto &at) { return !at.table.empty(); });
    for (auto one = all.end(); one != all.begin();)
        if (--one; one != first)
            cut(*one, least);
    if (first != all.end())
        cut(*first, least_of_first);
    for (auto one = all.end(); one != all.begin() && too_many() > 0;)
        if (--one; one != first && !one->table.empty())
            one->shown = false;
    if (first != all.end())
        cut(*first, least);
    for (Paragraph &one : all) { // what that leaves free goes to the first
        const int spare = -too_many();
        const std::size_t more = one.table.size() - one.rows;
        if (!one.shown || spare <= 0 || more == 0)
            continue;
        one.rows += static_cast<int>(more) <= spare + 1 ? more : static_cast<std::size_t>(spare);
    }
}

} // namespace

std::string fitted_text(const std::string &body, const std::vector<std::string> &notes,
                        const std::string &last, int lines) {
    std::vector<Paragraph> all = paragraphs_of(body);
    std::size_t told = notes.size();
    if (lines > 0) {
        const int room =
            lines - (last.empty() ? 0 : 1 + static_cast<int>(std::ranges::count(last, '\n')));
        constexpr int fair = 8; // notes have so many lines at least, the worst are first
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
