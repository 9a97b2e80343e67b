#pragma once

#include <string>
#include <toml++/toml.h>
#include <vector>

namespace whirl::oracles {

/// Size of one unit in SI and radians; throws std::runtime_error for one that no case uses.
[[nodiscard]] double size_of_unit(const std::string &unit);

/// A number, or a text "25 mm"; throws std::runtime_error.
[[nodiscard]] double number(const toml::node &node);
/// The same of an entry; `missing` where there is none.
[[nodiscard]] double number(const toml::table &table, const std::string &key, double missing = 0);

/// Sets "path.to[2].key=value"; the value in TOML, or a text without quotes.
void apply_setting(toml::table &root, const std::string &setting);

/// Rows of a CSV file by column, in SI where a header gives a unit: "speed [rpm]". Cells that are
/// no numbers (names of materials) are in `names`.
struct CsvColumn {
    std::string name;
    std::vector<double> numbers;
    std::vector<std::string> names;
};
[[nodiscard]] std::vector<CsvColumn> read_csv(const std::string &file);

/// The items of a list of tables; none where there is none.
[[nodiscard]] std::vector<const toml::table *> tables_of(const toml::table &root,
                                                         const std::string &name);
/// The named part of a case; an empty one where there is none.
[[nodiscard]] const toml::table &part(const toml::table &root, const std::string &name);
/// A text; empty where there is none.
[[nodiscard]] std::string word(const toml::table &table, const std::string &key);
[[nodiscard]] bool yes(const toml::table &table, const std::string &key);

} // namespace whirl::oracles
