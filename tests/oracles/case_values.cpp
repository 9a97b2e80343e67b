#include "oracles/case_values.h"

#include <cstdlib>
#include <fstream>
#include <map>
#include <numbers>
#include <sstream>
#include <stdexcept>

namespace whirl::oracles {

namespace {

std::string trimmed(const std::string &text) {
    const auto first = text.find_first_not_of(" \t\r");
    if (first == std::string::npos)
        return {};
    return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// Entry of an array or table, made where it is missing.
toml::node &entry(toml::node &at, const std::string &key) {
    const auto bracket = key.find('[');
    toml::table &table = *at.as_table();
    const std::string name = key.substr(0, bracket);
    if (!table.contains(name))
        table.insert(name, toml::table{});
    if (bracket == std::string::npos)
        return *table.get(name);
    toml::array *array = table.get(name)->as_array();
    const auto index = static_cast<std::size_t>(std::atoi(key.c_str() + bracket + 1));
    if (!array || index >= array->size())
        throw std::runtime_error("no such entry in the case: " + key);
    return *array->get(index);
}

toml::table value_of(const std::string &text) {
    try {
        return toml::parse("value = " + text);
    } catch (const toml::parse_error &) {
        return toml::table{{"value", text}};
    }
}

} // namespace

double size_of_unit(const std::string &unit) {
    constexpr double pi = std::numbers::pi;
    static const std::map<std::string, double> sizes{
        {"", 1},           {"m", 1},         {"cm", 1e-2},   {"mm", 1e-3},    {"kN", 1e3},
        {"N", 1},          {"rpm", pi / 30}, {"Hz", 2 * pi}, {"rad/s", 1},    {"1/s", 1},
        {"deg", pi / 180}, {"rad", 1},       {"kg m2", 1},   {"1/kg", 1},     {"1", 1},
        {"GPa", 1e9},      {"N/m", 1},       {"MN/m", 1e6},  {"kN s/m", 1e3}, {"g mm", 1e-6},
        {"%", 1},          {"g", 1e-3},      {"kN m", 1e3},  {"m/N", 1},      {"m/s", 1},
        {"GN/m", 1e9},     {"MN s/m", 1e6},  {"t", 1e3},     {"kg m", 1}};
    const auto found = sizes.find(unit);
    if (found == sizes.end())
        throw std::runtime_error("unit not known to the oracles: " + unit);
    return found->second;
}

double number(const toml::node &node) {
    if (const auto value = node.value<double>(); value && node.is_number())
        return *value;
    const auto text = node.value<std::string>();
    if (!text)
        throw std::runtime_error("an entry of the case is no number");
    char *end = nullptr;
    const double value = std::strtod(text->c_str(), &end);
    if (end == text->c_str())
        throw std::runtime_error("no number: " + *text);
    return value * size_of_unit(trimmed(end));
}

double number(const toml::table &table, const std::string &key, double missing) {
    const toml::node *node = table.get(key);
    return node ? number(*node) : missing;
}

void apply_setting(toml::table &root, const std::string &setting) {
    const auto equal = setting.find('=');
    std::istringstream path(setting.substr(0, equal));
    toml::node *at = &root;
    std::string key;
    std::getline(path, key, '.');
    for (std::string next; std::getline(path, next, '.'); key = next)
        at = &entry(*at, key);
    const toml::table value = value_of(setting.substr(equal + 1));
    value.get("value")->visit(
        [&](const auto &node) { at->as_table()->insert_or_assign(key, node); });
}

std::vector<CsvColumn> read_csv(const std::string &file) {
    std::ifstream stream(file);
    if (!stream)
        throw std::runtime_error("cannot read " + file);
    std::vector<CsvColumn> columns;
    std::vector<double> units;
    std::string line;
    for (bool header = true; std::getline(stream, line); header = false) {
        if (header && line.rfind('#', 0) == 0 && std::getline(stream, line).fail()) // a comment
            break;
        std::istringstream cells(line);
        std::string cell;
        for (std::size_t i = 0; std::getline(cells, cell, ','); ++i) {
            cell = trimmed(cell);
            if (header) {
                const auto bracket = cell.find('[');
                columns.push_back({trimmed(cell.substr(0, bracket)), {}, {}});
                units.push_back(
                    bracket == std::string::npos
                        ? 1
                        : size_of_unit(cell.substr(bracket + 1, cell.find(']') - bracket - 1)));
                continue;
            }
            char *end = nullptr;
            columns.at(i).numbers.push_back(std::strtod(cell.c_str(), &end) * units.at(i));
            columns.at(i).names.push_back(cell);
        }
    }
    return columns;
}

std::vector<const toml::table *> tables_of(const toml::table &root, const std::string &name) {
    std::vector<const toml::table *> out;
    if (const toml::array *array = root.get(name) ? root.get(name)->as_array() : nullptr)
        for (const toml::node &item : *array)
            out.push_back(item.as_table());
    return out;
}

const toml::table &part(const toml::table &root, const std::string &name) {
    static const toml::table nothing;
    const toml::node *node = root.get(name);
    return node ? *node->as_table() : nothing;
}

std::string word(const toml::table &table, const std::string &key) {
    const toml::node *node = table.get(key);
    return node ? node->value<std::string>().value_or("") : "";
}

bool yes(const toml::table &table, const std::string &key) {
    const toml::node *node = table.get(key);
    return node && node->value<bool>().value_or(false);
}

} // namespace whirl::oracles
