#pragma once

#include <nlohmann/json.hpp>

#include <string>

namespace whirl::tests {

/// A TOML file as JSON.
[[nodiscard]] nlohmann::json json_of_toml_file(const std::string &path);
/// A TOML text as JSON.
[[nodiscard]] nlohmann::json json_of_toml(const std::string &text);

/// JSON as a TOML file: a line for each key at the top, tables inside of lines.
[[nodiscard]] std::string to_toml(const nlohmann::json &document);

} // namespace whirl::tests
