// Results in other units against the same results in SI: every column of every file.

#include "cases/program_run.h"
#include "input/units.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <sstream>
#include <unistd.h>

namespace units_test {

namespace fs = std::filesystem;
using whirl::input::Quantity;

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

std::vector<std::string> cells(const std::string &line) {
    std::vector<std::string> out(1);
    bool quoted = false;
    for (const char letter : line) {
        quoted = letter == '"' ? !quoted : quoted;
        if (letter == ',' && !quoted)
            out.emplace_back();
        else
            out.back() += letter;
    }
    return out;
}

struct Heading {
    std::string name, unit;
    bool peak_to_peak = false;
};
Heading heading_of(const std::string &cell) {
    Heading out{cell, "", false};
    if (const std::size_t at = cell.rfind(" ["); at != std::string::npos && cell.back() == ']') {
        out.name = cell.substr(0, at);
        out.unit = cell.substr(at + 2, cell.size() - at - 3);
    }
    if (out.name.ends_with(" pk-pk")) {
        out.peak_to_peak = true;
        out.name.resize(out.name.size() - 6);
    }
    return out;
}

/// What a unit is multiplied by for the SI one, by the library that reads units.
double size_of(const std::string &unit, const std::string &si) {
    static const std::map<std::string, Quantity> quantities{
        {"m", Quantity::length},      {"rad/s", Quantity::angular_speed}, {"N", Quantity::force},
        {"N/m", Quantity::stiffness}, {"N s/m", Quantity::damping},       {"kg", Quantity::mass},
        {"kg m2", Quantity::inertia}, {"kg m", Quantity::imbalance}};
    const auto found = quantities.find(si);
    if (found == quantities.end())
        return unit == si ? 1 : NAN;
    return whirl::input::unit_factor(unit, found->second).value_or(NAN);
}

/// @returns the number of columns with another unit
int expect_same_file(const fs::path &in_si, const fs::path &in_others) {
    std::istringstream si(text_of(in_si));
    std::istringstream other(text_of(in_others));
    std::string line;
    std::string other_line;
    std::getline(si, line);
    std::getline(other, other_line);
    const auto head = cells(line);
    const auto other_head = cells(other_line);
    EXPECT_EQ(head.size(), other_head.size());
    std::vector<double> factors;
    int converted = 0;
    for (std::size_t i = 0; i < head.size() && i < other_head.size(); ++i) {
        const Heading a = heading_of(head[i]);
        const Heading b = heading_of(other_head[i]);
        EXPECT_EQ(a.name, b.name);
        factors.push_back(size_of(b.unit, a.unit) / (b.peak_to_peak ? 2 : 1));
        EXPECT_TRUE(std::isfinite(factors.back())) << head[i] << " " << other_head[i];
        converted += a.unit != b.unit ? 1 : 0;
    }
    while (std::getline(si, line)) {
        EXPECT_TRUE(std::getline(other, other_line));
        const auto row = cells(line);
        const auto other_row = cells(other_line);
        EXPECT_EQ(row.size(), other_row.size());
        for (std::size_t i = 0; i < row.size() && i < other_row.size(); ++i) {
            char *end = nullptr;
            const double value = std::strtod(row[i].c_str(), &end);
            const bool number = !row[i].empty() && *end == '\0';
            if (!number || factors.at(i) == 1) {
                EXPECT_EQ(row[i], other_row[i]);
                continue;
            }
            EXPECT_NEAR(std::strtod(other_row[i].c_str(), nullptr) * factors[i], value,
                        1e-15 * 4 * std::abs(value))
                << head[i];
        }
    }
    EXPECT_FALSE(std::getline(other, other_line));
    return converted;
}

class Units : public testing::TestWithParam<At> {
  protected:
    fs::path folder = fs::temp_directory_path() /
                      ("whirl_units_" + std::to_string(getpid()) + "_" + GetParam().command);

    void TearDown() override { fs::remove_all(folder); }

    [[nodiscard]] nlohmann::json run(const std::string &name, std::vector<std::string> more) const {
        std::vector<std::string> all{GetParam().command,
                                     std::string(WHIRL_ROOT) + "/cases/" + GetParam().scene,
                                     "--json", "--out", (folder / name).string()};
        all.insert(all.end(), GetParam().more.begin(), GetParam().more.end());
        all.insert(all.end(), more.begin(), more.end());
        const auto done =
            whirl::tests::run_program(WHIRL_PROGRAM, all, folder.string() + ".errors");
        EXPECT_EQ(done.status, 0) << done.errors;
        auto json = nlohmann::json::parse(done.output, nullptr, false);
        json.erase("seconds");
        json.erase("provenance");
        return json;
    }
};

/// A number is another one in some unit of those that are named.
bool same_in_some_unit(double value, double si, const nlohmann::json &units,
                       double relative = 1e-14) {
    for (std::string name : units) {
        const bool twice = name.ends_with(" pk-pk");
        if (twice)
            name.resize(name.size() - 6);
        for (const char *quantity : {"m", "rad/s", "N", "N/m", "kg", "kg m2"}) {
            const double size = size_of(name, quantity) / (twice ? 2 : 1);
            if (std::abs(value * size - si) <= relative * std::abs(si))
                return true;
        }
    }
    return false;
}

/// A number, with the word after it, which may be a unit.
const std::regex number_in_words("([-+]?[0-9][0-9.]*(?:e[-+]?[0-9]+)?)(?: [A-Za-z/]+)?");

/// A sentence in the units asked for says the same: the words are the same beside units, and its
/// numbers in one of these, as they are rounded there.
void expect_same_sentence(const std::string &words, const std::string &si,
                          const nlohmann::json &units) {
    constexpr double rounded = 5e-4; // of four digits
    EXPECT_EQ(std::regex_replace(words, number_in_words, "#"),
              std::regex_replace(si, number_in_words, "#"));
    std::sregex_iterator a(words.begin(), words.end(), number_in_words);
    std::sregex_iterator b(si.begin(), si.end(), number_in_words);
    for (const std::sregex_iterator none; a != none && b != none; ++a, ++b)
        EXPECT_TRUE((*a)[1] == (*b)[1] ||
                    same_in_some_unit(std::stod((*a)[1]), std::stod((*b)[1]), units, rounded))
            << words << "\n"
            << si;
}

/// Each number of a result is that of the other one, or it in one of the units; in a row that says
/// its unit, in that one.
void expect_same_numbers(const nlohmann::json &json, const nlohmann::json &si,
                         const nlohmann::json &units, bool sentences = false) {
    if (json.is_structured()) {
        ASSERT_EQ(json.size(), si.size());
        const bool row = json.is_object() && json.contains("unit") && json["unit"] != si["unit"];
        nlohmann::json own = units;
        if (row)
            own["row"] = json["unit"];
        for (auto a = json.begin(), b = si.begin(); a != json.end(); ++a, ++b) {
            const std::string key = json.is_object() ? a.key() : "";
            if (row && key == "unit")
                continue;
            expect_same_numbers(*a, *b, own,
                                sentences || key == "notes" || key == "findings" ||
                                    key == "evidence" || key == "sentence");
        }
    } else if (json.is_number() && si.is_number() && json != si) {
        EXPECT_TRUE(same_in_some_unit(json.get<double>(), si.get<double>(), units))
            << json << " " << si;
    } else if (sentences && json.is_string() && si.is_string()) {
        expect_same_sentence(json, si, units);
    } else {
        EXPECT_EQ(json, si);
    }
}

TEST_P(Units, ConvertBackToTheSameNumbers) {
    const nlohmann::json si = run("si", {});
    EXPECT_EQ(run("us", {"--units", "us", "--peak-to-peak"}), si); // JSON stays in SI
    int converted = 0;
    for (const auto &entry : fs::directory_iterator(folder / "si"))
        if (entry.path().extension() == ".csv")
            converted += expect_same_file(entry.path(), folder / "us" / entry.path().filename());
    EXPECT_GT(converted, 0);
    nlohmann::json others = run("json", {"--units", "us", "--peak-to-peak", "--json-units"});
    const nlohmann::json units = others.at("units");
    EXPECT_FALSE(units.empty());
    others.erase("units");
    for (const auto &[key, unit] : units.items())
        EXPECT_TRUE(unit.is_string()) << key;
    expect_same_numbers(others, si, units);
    if (!si.contains("peaks"))
        return;
    constexpr double mil = 25.4e-6;
    constexpr double pound_force = 4.4482216152605;
    for (std::size_t i = 0; i < si["peaks"].size(); ++i) {
        const double value = si["peaks"][i]["value"];
        const bool force = si["peaks"][i]["of"] == "bearing";
        EXPECT_NEAR(others["peaks"][i]["value"].get<double>() / value,
                    force ? 1 / pound_force : 2 / mil, force ? 1e-12 : 1e-7)
            << i;
    }
}

INSTANTIATE_TEST_SUITE_P(
    Commands, Units,
    testing::Values(At{"show", "centrifuge_two_balls", {}},
                    At{"campbell", "nelson_mcvaugh", {"--set", "speeds.count=5"}},
                    At{"critical", "friswell_5_9_2", {"--map", "--set", "critical_map.points=5"}},
                    At{"response", "lalanne_three_discs", {"--set", "speeds.count=5"}},
                    At{"stability", "overhung_cross_coupled", {"--set", "speeds.count=5"}},
                    At{"balance",
                       "extractor_two_plane",
                       {"--set", "speeds.count=5", "--set", "balance.balanced_position=false"}},
                    At{"modes", "friswell_5_9_4", {}}),
    [](const auto &at) { return std::string(at.param.command); });

/// Rows of one list that are speeds, masses and lengths: each says its unit, with --json-units the
/// other one.
class RowUnits : public Units {};

/// The rows of a result that say "unit", with the first of their numbers.
void rows_with_units(const nlohmann::json &json, std::vector<nlohmann::json> &rows) {
    if (json.is_object() && json.contains("unit") && json["unit"].is_string())
        rows.push_back(json);
    if (json.is_structured())
        for (const auto &item : json)
            rows_with_units(item, rows);
}

TEST_P(RowUnits, ConvertBackToTheSameNumbers) {
    const nlohmann::json si = run("si", {});
    nlohmann::json others = run("json", {"--units", "us", "--json-units"});
    const nlohmann::json units = others.at("units");
    others.erase("units");
    expect_same_numbers(others, si, units);
    std::vector<nlohmann::json> rows;
    std::vector<nlohmann::json> si_rows;
    rows_with_units(others, rows);
    rows_with_units(si, si_rows);
    ASSERT_EQ(rows.size(), si_rows.size());
    int converted = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (rows[i]["unit"] == si_rows[i]["unit"])
            continue;
        ++converted;
        for (const char *key : {"closed_form", "nominal"})
            if (rows[i].contains(key) && rows[i][key].is_number()) {
                const double size = size_of(rows[i]["unit"], si_rows[i]["unit"]);
                EXPECT_NEAR(rows[i][key].get<double>() * size, si_rows[i][key].get<double>(),
                            4e-15 * si_rows[i][key].get<double>());
            }
    }
    EXPECT_GT(converted, 2);
}

INSTANTIATE_TEST_SUITE_P(
    Commands, RowUnits,
    testing::Values(At{"rigid-limit", "rigid_limit", {}},
                    At{"samples", "uncertain_jeffcott", {"--set", "samples.count=4"}}),
    [](const auto &at) { return std::string(at.param.command).substr(0, 5); });

} // namespace units_test
