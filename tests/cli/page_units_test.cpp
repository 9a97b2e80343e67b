// Tables of reports and of the terminal in two sets of units: each number is in the unit that its
// heading, or the cell itself, names.

#include "cases/program_run.h"
#include "input/units.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <regex>
#include <sstream>
#include <tuple>
#include <unistd.h>

namespace {

namespace fs = std::filesystem;
using whirl::input::Quantity;

using Row = std::vector<std::string>;

struct At {
    const char *command;
    const char *scene;
    std::vector<std::string> more;
};

std::string text_of(const fs::path &file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

/// All pieces between two marks.
std::vector<std::string> between(const std::string &text, const std::string &from,
                                 const std::string &to) {
    std::vector<std::string> out;
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at)) {
        const std::size_t end = text.find(to, at);
        if (end == std::string::npos)
            break;
        out.push_back(text.substr(at + from.size(), end - at - from.size()));
        at = end;
    }
    return out;
}

/// Rows of cells of all tables of a page, and of no other text.
std::vector<std::vector<Row>> tables_of(const std::string &page) {
    std::vector<std::vector<Row>> tables;
    for (const std::string &table : between(page, "<table", "</table>")) {
        tables.emplace_back();
        for (const std::string &line : between(table, "<tr>", "</tr>")) {
            Row row;
            static const std::regex cell("<t[hd][^>]*>([^<]*)<");
            for (std::sregex_iterator i(line.begin(), line.end(), cell), end; i != end; ++i)
                row.push_back((*i)[1]);
            tables.back().push_back(row);
        }
    }
    return tables;
}

/// A unit as a factor to SI, from the library that reads units; none: no unit.
std::optional<double> size_of(const std::string &unit) {
    for (const Quantity quantity :
         {Quantity::length, Quantity::angular_speed, Quantity::mass, Quantity::force,
          Quantity::stiffness, Quantity::damping, Quantity::inertia, Quantity::imbalance})
        if (const auto factor = whirl::input::unit_factor(unit, quantity))
            return factor;
    return std::nullopt;
}

struct Measured {
    double value = 0;
    std::optional<double> unit;
};
/// "12.5", or "12.5 mm".
std::optional<Measured> measured(const std::string &cell) {
    char *end = nullptr;
    const double value = std::strtod(cell.c_str(), &end);
    if (end == cell.c_str() || (*end != '\0' && *end != ' '))
        return std::nullopt;
    if (*end == '\0')
        return Measured{value, std::nullopt};
    const auto unit = size_of(end + 1);
    return unit ? std::optional(Measured{value, unit}) : std::nullopt;
}

/// Words of a line of the terminal, three blanks between them, and the places of their ends.
struct Word {
    std::string text;
    std::size_t begin = 0, end = 0; ///< in letters
};
std::vector<Word> words_of(const std::string &line) {
    const auto letters = [&line](std::size_t bytes) {
        return static_cast<std::size_t>(
            std::count_if(line.begin(), line.begin() + static_cast<std::ptrdiff_t>(bytes),
                          [](char at) { return (at & 0xC0) != 0x80; }));
    };
    std::vector<Word> words;
    std::size_t at = line.find_first_not_of(' ');
    while (at != std::string::npos) {
        const std::size_t gap = std::min(line.find("   ", at), line.size());
        words.push_back({line.substr(at, gap - at), letters(at), letters(gap)});
        at = line.find_first_not_of(' ', gap);
    }
    return words;
}

/// Tables of the terminal: a heading has no number; columns but the first end at one place.
std::vector<std::vector<Row>> tables_of_terminal(const std::string &text) {
    std::vector<std::vector<Row>> tables;
    std::vector<Word> heads;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        const std::vector<Word> words = words_of(line);
        if (std::none_of(words.begin(), words.end(),
                         [](const Word &word) { return measured(word.text).has_value(); })) {
            heads = words;
            tables.emplace_back();
        }
        Row row;
        for (const Word &head : heads) {
            const auto of = std::find_if(words.begin(), words.end(), [&](const Word &word) {
                return word.end == head.end || (word.begin == head.begin && word.begin == 2);
            });
            row.push_back(of == words.end() ? "" : of->text);
        }
        if (!tables.empty())
            tables.back().push_back(row);
    }
    return tables;
}

/// The unit in brackets at the end of a heading, its last two words with a square ("kg mm2"), or
/// its last word.
std::optional<double> size_in(std::string heading) {
    double times = 1;
    if (const std::size_t at = heading.find("pk-pk"); at != std::string::npos) {
        const bool last = heading[at - 1] == ' ';
        heading.erase(last ? at - 1 : at, 6);
        times = 0.5; // an amplitude is half of that
    }
    static const std::regex in_brackets(".*\\(([^()]*)\\)");
    static const std::regex squared("(?:.* )?([^ 0-9]+ [^ 0-9]+2)");
    static const std::regex last("(?:.* )?([^ 0-9]+)");
    std::smatch found;
    if (!std::regex_match(heading, found, in_brackets) &&
        !std::regex_match(heading, found, squared) && !std::regex_match(heading, found, last))
        return std::nullopt;
    const auto size = size_of(found[1]);
    return size ? std::optional(*size * times) : std::nullopt;
}

/// The unit that another cell of the row names: "amplitude (µm)", or one in a column of units.
std::pair<double, double> named_elsewhere(const Row &row, const Row &other) {
    for (std::size_t i = 0; i < row.size(); ++i)
        if (row[i] != other[i] && !measured(row[i]))
            if (const auto a = size_in(row[i]), b = size_in(other[i]); a && b)
                return {*a, *b};
    return {1, 1};
}

/// @returns how many numbers were in different units
int expect_same(const Row &heads, const Row &row, const Row &other_heads, const Row &other_row) {
    int converted = 0;
    for (std::size_t i = 0; i < row.size(); ++i) {
        const auto a = measured(row[i]);
        const auto b = measured(other_row[i]);
        if (!a || !b)
            continue;
        const auto of_heading = size_in(heads[i]);
        const auto of_other = size_in(other_heads[i]);
        double unit = a->unit.value_or(of_heading.value_or(1));
        double other = b->unit.value_or(of_other.value_or(1));
        if (!a->unit && !of_heading && a->value != b->value)
            std::tie(unit, other) = named_elsewhere(row, other_row);
        converted += unit != other ? 1 : 0;
        // What is printed has two digits at the least; a unit that is not that of the number is
        // off by far more.
        EXPECT_NEAR(a->value * unit, b->value * other, 0.06 * std::abs(a->value * unit))
            << heads[i] << ": " << row[i] << "; " << other_heads[i] << ": " << other_row[i];
    }
    return converted;
}

int expect_same(const std::vector<std::vector<Row>> &tables,
                const std::vector<std::vector<Row>> &others) {
    int converted = 0;
    EXPECT_EQ(tables.size(), others.size());
    for (std::size_t t = 0; t < tables.size() && t < others.size(); ++t) {
        const auto &table = tables[t];
        const auto &other = others[t];
        EXPECT_EQ(table.size(), other.size()) << table.front().front();
        for (std::size_t k = 1; k < table.size() && k < other.size(); ++k)
            if (table[k].size() == table[0].size() && other[k].size() == other[0].size() &&
                table[k].size() == other[k].size())
                converted += expect_same(table[0], table[k], other[0], other[k]);
    }
    return converted;
}

/// A column of lengths is of places and sizes: vibration has its own unit.
void expect_no_vibration_in_lengths(const std::vector<std::vector<Row>> &tables) {
    static const std::regex length("(.*)\\bin\\)?");
    static const std::regex vibrates(".*([Aa]mplitude|[Pp]eak|[Ss]teady|at the end|"
                                     "balls|[Rr]eading|twice).*");
    for (const auto &table : tables)
        for (const std::string &heading : table.front())
            EXPECT_FALSE(std::regex_match(heading, length) && std::regex_match(heading, vibrates))
                << heading;
}

class PageUnits : public testing::TestWithParam<At> {
  protected:
    fs::path folder =
        fs::temp_directory_path() / ("whirl_page_units_" + std::to_string(getpid()) + "_" +
                                     GetParam().command + "_" + GetParam().scene);

    void TearDown() override { fs::remove_all(folder); }

    /// @returns what stands on the terminal
    [[nodiscard]] std::string run(const std::string &name,
                                  const std::vector<std::string> &units) const {
        std::vector<std::string> all{GetParam().command,
                                     std::string(WHIRL_ROOT) + "/cases/" + GetParam().scene,
                                     "--out", (folder / name).string()};
        all.insert(all.end(), GetParam().more.begin(), GetParam().more.end());
        all.insert(all.end(), units.begin(), units.end());
        const auto done =
            whirl::tests::run_program(WHIRL_PROGRAM, all, folder.string() + ".errors");
        EXPECT_EQ(done.status, 0) << done.errors;
        return done.output;
    }
    [[nodiscard]] std::vector<std::vector<Row>> page(const std::string &name) const {
        return tables_of(text_of(folder / name / "report.html"));
    }
};

TEST_P(PageUnits, AreThoseOfTheNumbers) {
    const std::string metric = run("mm", {"--units", "mm-rpm"});
    const std::string american = run("us", {"--units", "us", "--units", "speed=Hz", "--units",
                                            "frequency=cpm", "--peak-to-peak"});
    EXPECT_GT(expect_same(page("mm"), page("us")), 0);
    expect_same(tables_of_terminal(metric), tables_of_terminal(american));
    expect_no_vibration_in_lengths(page("us"));
    expect_no_vibration_in_lengths(tables_of_terminal(american));
}

INSTANTIATE_TEST_SUITE_P(
    Commands, PageUnits,
    testing::Values(At{"show", "centrifuge_two_balls", {}},
                    At{"campbell", "nelson_mcvaugh", {"--set", "speeds.count=5"}},
                    At{"critical", "friswell_5_9_2", {"--map", "--set", "critical_map.points=5"}},
                    At{"response", "lalanne_three_discs", {"--set", "speeds.count=5"}},
                    At{"response", "keyway_gravity", {"--set", "speeds.count=5"}},
                    At{"stability", "overhung_cross_coupled", {"--set", "speeds.count=5"}},
                    At{"balance",
                       "disc_type_short",
                       {"--set", "speeds.count=5", "--set", "balance.balanced_position=false",
                        "--set", "balance.simulated=0"}},
                    At{"simulate", "runup_jeffcott", {"--set", "simulate.time=6"}},
                    At{"simulate", "rodrigues_two_plane", {"--set", "simulate.time=0.5"}},
                    At{"samples", "uncertain_jeffcott", {"--set", "samples.count=6"}},
                    At{"modes", "friswell_5_9_4", {}}),
    [](const auto &at) { return std::string(at.param.command) + "_" + at.param.scene; });

/// A reader who asked for rpm and Hz meets no rad/s: in no table, note or failure of any case.
/// (Rows of rigid-limit name their own unit.)
class SpeedUnits : public testing::TestWithParam<std::string> {};

TEST_P(SpeedUnits, AreThoseAskedForInAllThatIsRead) {
    const fs::path folder =
        fs::temp_directory_path() / ("whirl_speed_units_" + std::to_string(getpid()) + GetParam());
    for (const char *command :
         {"show", "campbell", "critical", "stability", "response", "balance", "modes"}) {
        const auto done = whirl::tests::run_program(
            WHIRL_PROGRAM,
            {command, std::string(WHIRL_ROOT) + "/cases/" + GetParam(), "--out", folder.string(),
             "--units", "mm-rpm", "--set", "speeds.count=3", "--set", "balance.simulated=0"},
            folder.string() + ".errors");
        if (done.status ==
            2) // no such command for this case, or mistakes of input: those are in SI
            continue;
        EXPECT_EQ((done.output + done.errors).find("rad/s"), std::string::npos)
            << command << done.output << done.errors;
        if (done.status == 0)
            for (const auto &table : tables_of(text_of(folder / "report.html")))
                for (const Row &row : table)
                    for (const std::string &cell : row)
                        EXPECT_EQ(cell.find("rad/s"), std::string::npos) << command << ": " << cell;
    }
    fs::remove_all(folder);
}

// A rotor with imbalances, one unsymmetric in both planes, one with balancers.
INSTANTIATE_TEST_SUITE_P(Cases, SpeedUnits,
                         testing::Values("lalanne_three_discs", "hill_rotor",
                                         "centrifuge_two_balls"),
                         [](const auto &at) { return at.param; });

} // namespace
