// docs/schema/case.schema.json against the reader, the shipped cases and docs/case_format.md.

#include "input/case_file.h"
#include "model/errors.h"
#include "schema/tables.h"
#include "schema/toml.h"
#include "support/schema.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <set>
#include <sstream>
#include <unistd.h>

namespace {

namespace fs = std::filesystem;
using namespace whirl::tests;
using nlohmann::json;
using Keys = std::set<std::string>;

class CaseSchema : public testing::Test {
  protected:
    const json schema = schema_file("case.schema.json");
    const json complete = json_of_toml_file(WHIRL_ROOT "/tests/schema/complete.toml");
    const std::map<std::string, SchemaTable> tables = tables_of(schema, complete);
    const fs::path file =
        fs::temp_directory_path() / ("whirl_schema_" + std::to_string(getpid()) + ".toml");

    void TearDown() override { fs::remove(file); }

    /// What the reader says of a case; empty where it takes it.
    [[nodiscard]] std::string mistakes_in(const json &document) const {
        std::ofstream(file) << to_toml(document);
        try {
            static_cast<void>(whirl::input::load_case(file, {}));
        } catch (const whirl::model::BadInput &error) {
            return error.what();
        }
        return "";
    }
    /// The keys that the reader knows in the table at a place: it lists them to whoever writes one
    /// that is like none of them.
    [[nodiscard]] Keys known_to_reader(const json::json_pointer &place) const {
        const std::string stranger = "qqqqqqqqqqqqqqqqqqqqqqqqqqqqqqqqqqqqqqqq";
        json document = complete;
        document[place][stranger] = 1;
        const std::string said = mistakes_in(document);
        const std::string before = stranger + ": unknown key, known are ";
        Keys keys;
        if (said.find(before) == std::string::npos)
            return keys;
        std::istringstream list(said.substr(said.find(before) + before.size()));
        std::string key;
        while (list >> key && keys.insert(key.substr(0, key.find(','))).second && key.back() == ',')
            continue;
        return keys;
    }
};

Keys keys_of(const json &properties) {
    Keys keys;
    for (const auto &entry : properties.items())
        keys.insert(entry.key());
    return keys;
}

/// Values that a rule refuses: of another type, and just outside its range.
std::vector<json> refused_values(const json &rule) {
    std::vector<json> values;
    values.emplace_back(rule.value("type", json()) == "boolean" ? json("yes") : json(true));
    for (const char *bound : {"exclusiveMinimum", "exclusiveMaximum"})
        if (rule.contains(bound))
            values.push_back(rule.at(bound));
    if (rule.contains("minimum"))
        values.emplace_back(rule.at("minimum").get<double>() - 1);
    if (rule.contains("maximum"))
        values.emplace_back(rule.at("maximum").get<double>() + 1);
    if (rule.contains("enum"))
        values.emplace_back("no such word");
    if (rule.contains("items") && !rule.at("items").contains("properties"))
        for (const json &item : refused_values(rule.at("items")))
            values.push_back(json::array({item}));
    return values;
}

/// Whether a mistake is told at this key, or inside of it, other than that it is unknown.
bool tells(const std::string &said, const std::string &path) {
    std::istringstream lines(said);
    for (std::string line; std::getline(lines, line);)
        if ((line.find(": " + path + ": ") != std::string::npos ||
             line.find(": " + path + "[") != std::string::npos) &&
            line.find("unknown key") == std::string::npos)
            return true;
    return false;
}

TEST_F(CaseSchema, takes_every_shipped_case) {
    EXPECT_EQ(broken_rules(schema, complete), "");
    int found = 0;
    for (const auto &entry : fs::recursive_directory_iterator(WHIRL_ROOT "/cases")) {
        if (entry.path().extension() != ".toml")
            continue;
        ++found;
        EXPECT_EQ(broken_rules(schema, json_of_toml_file(entry.path())), "") << entry.path();
    }
    EXPECT_GT(found, 30);
}

TEST_F(CaseSchema, knows_the_keys_of_the_reader_and_no_others) {
    ASSERT_EQ(mistakes_in(complete), "");
    for (const auto &[of, table] : tables) {
        if (of == "material") // any name
            continue;
        ASSERT_FALSE(table.places.empty()) << "complete.toml has no table " << of;
        Keys known;
        for (const auto &place : table.places)
            known.merge(known_to_reader(place));
        EXPECT_EQ(keys_of(table.properties), known) << "in " << of;
    }
}

TEST_F(CaseSchema, refuses_unknown_keys_in_every_table) {
    for (const auto &[of, table] : tables)
        for (const auto &place : table.places) {
            json document = complete;
            document[place]["no_such_key"] = 1;
            EXPECT_NE(broken_rules(schema, document), "") << path_text(place);
        }
}

// So the schema is nowhere stricter than the reader: what an editor underlines is a mistake.
TEST_F(CaseSchema, what_it_refuses_the_reader_refuses_at_that_key) {
    for (const auto &[of, table] : tables)
        for (const auto &[key, rule] : table.properties.items())
            for (const json &value : refused_values(rule)) {
                bool told = false;
                for (const auto &place : table.places) {
                    json document = complete;
                    document[place][key] = value;
                    EXPECT_NE(broken_rules(part_of_schema(schema, rule), value), "")
                        << path_text(place / key) << " = " << value;
                    told = told || tells(mistakes_in(document), path_text(place / key));
                }
                EXPECT_TRUE(told) << of << "." << key << " = " << value;
            }
}

/// The cells of a line of a Markdown table, from the first bar on.
std::vector<std::string> cells_of(const std::string &line) {
    std::vector<std::string> cells;
    std::istringstream rest(line.substr(1));
    for (std::string cell; std::getline(rest, cell, '|');)
        cells.push_back(cell);
    return cells;
}

/// The keys in the tables of docs/case_format.md that say what a case may have.
Keys documented_keys() {
    static const std::regex name("`([A-Za-z_]\\w*)`");
    Keys keys;
    std::ifstream page(WHIRL_ROOT "/docs/case_format.md");
    std::size_t column = 0; // of the keys
    for (std::string line; std::getline(page, line) && !line.starts_with("## What every");) {
        if (!line.starts_with("|"))
            continue;
        const std::vector<std::string> cells = cells_of(line);
        if (cells.front() == " key " || cells.front() == " section ") {
            column = cells.front() == " key " ? 0 : 1;
            continue;
        }
        const std::string &cell = cells.at(column);
        for (std::sregex_iterator at(cell.begin(), cell.end(), name), end; at != end; ++at)
            keys.insert((*at)[1]);
    }
    return keys;
}

/// Every word between backquotes on that page.
Keys quoted_words() {
    std::ostringstream text;
    text << std::ifstream(WHIRL_ROOT "/docs/case_format.md").rdbuf();
    const std::string page = text.str();
    static const std::regex quoted("`[^`\n]+`");
    static const std::regex word("[A-Za-z_]\\w*");
    Keys words;
    for (std::sregex_iterator at(page.begin(), page.end(), quoted), end; at != end; ++at) {
        const std::string inside = at->str();
        for (std::sregex_iterator in(inside.begin(), inside.end(), word); in != end; ++in)
            words.insert(in->str());
    }
    return words;
}

TEST_F(CaseSchema, has_the_keys_of_the_documentation_and_no_others) {
    Keys keys;
    for (const auto &[of, table] : tables)
        keys.merge(keys_of(table.properties));
    for (const std::string &key : documented_keys())
        EXPECT_TRUE(keys.contains(key)) << key << " is documented and not in the schema";
    const Keys words = quoted_words();
    for (const std::string &key : keys)
        EXPECT_TRUE(words.contains(key)) << key << " is in the schema and not documented";
}

} // namespace
