#pragma once

#include <nlohmann/json.hpp>

#include <map>
#include <string>
#include <vector>

namespace whirl::tests {

/// A table that the schema of the case file knows.
struct SchemaTable {
    nlohmann::json properties;                        ///< rules of its keys
    std::vector<nlohmann::json::json_pointer> places; ///< of such tables in a case
};

/// All tables of the schema by where they stand: "", "bearing", "simulate.force", "material.*".
/// @param document  a case: its tables of each kind become `places`
[[nodiscard]] std::map<std::string, SchemaTable> tables_of(const nlohmann::json &schema,
                                                           const nlohmann::json &document);

/// "bearing[0].k", as messages write it.
[[nodiscard]] std::string path_text(const nlohmann::json::json_pointer &place);

} // namespace whirl::tests
