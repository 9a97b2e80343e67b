#pragma once

#include "input/node.h"

#include <cstddef>
#include <map>
#include <string>
#include <string_view>

namespace whirl::input {

/// The tree of a TOML document; `file` names it in messages.
/// @throws model::BadInput "file:line: not valid TOML: ..." at the first syntax error.
[[nodiscard]] Node parse_toml(std::string_view document, const std::string &file);

/// Where an entry stands in a document, as bytes from its begin.
struct TextPlace {
    enum class Kind { value, inline_table, header };
    Kind kind = Kind::value;
    std::size_t begin = 0; ///< of the value, or of the header of a table
    std::size_t end = 0;
};

/// The places of all values and headers of a document by their paths, "bearing[0].k"; not of those
/// whose keys no path can name.
[[nodiscard]] std::map<std::string, TextPlace> text_places(std::string_view document);

/// A value given on the command line: a TOML value, or where it is none, the text itself.
[[nodiscard]] Node parse_value(std::string_view text, const Origin &origin);

/// A value as it stands in a TOML document.
[[nodiscard]] std::string value_text(const Node &value);
/// A key likewise.
[[nodiscard]] std::string key_text(const std::string &key);

/// The tree as a TOML document: entries by name, numbers with all digits.
[[nodiscard]] std::string to_toml(const Node &root);

} // namespace whirl::input
