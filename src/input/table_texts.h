#pragma once

#include <filesystem>
#include <string>

namespace whirl::input {

/// What the tables that a case names hold, one after the other: for processes that ought to read
/// the same. Tables that are no regular files are left out, for they can be read only once.
/// @param text  of the case, TOML (case_text)
/// @param file  it is in; tables are beside it
[[nodiscard]] std::string table_texts(const std::string &text, const std::filesystem::path &file);

} // namespace whirl::input
