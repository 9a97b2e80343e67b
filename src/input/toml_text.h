#pragma once

#include "input/node.h"

#include <string_view>

namespace whirl::input {

/// The tree of a TOML document; `file` names it in messages.
/// @throws model::BadInput "file:line: not valid TOML: ..." at the first syntax error.
[[nodiscard]] Node parse_toml(std::string_view document, const std::string &file);

/// A value given on the command line: a TOML value, or where it is none, the text itself.
[[nodiscard]] Node parse_value(std::string_view text, const Origin &origin);

/// The tree as a TOML document: entries by name, numbers with all digits.
[[nodiscard]] std::string to_toml(const Node &root);

} // namespace whirl::input
