#pragma once

#include "input/node.h"
#include "input/problems.h"

#include <string_view>

namespace whirl::input {

/// A mistake by which a text is no TOML document, in the words of a case: which key, what was
/// expected and what was given; in those of the parser where it is none of the common ones.
/// @param found   what the parser says
/// @param at      where it stopped
/// @param before  the lines before that one, or null where they are no document by themselves: then
///                the mistake is in a list or text of several lines
[[nodiscard]] Problem toml_mistake(std::string_view document, std::string_view found,
                                   const Origin &at, const Node *before);

} // namespace whirl::input
