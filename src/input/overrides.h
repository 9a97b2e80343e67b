#pragma once

#include "input/node.h"

#include <string>
#include <vector>

namespace whirl::input {

/// Applies overrides "path.to.key=value" to a case in their order. Missing keys and tables are
/// made; an item of a list must exist. "[*]" are all items of a list, "[left]" those of that name,
/// and no index is needed where there is one item. "path.to.key=" takes the entry or the item out.
/// Mistakes are named "--set path.to.key=value".
void apply_overrides(Node &root, const std::vector<std::string> &overrides, Problems &problems);

/// Sets what a path speaks of to a value, as an override does.
/// @returns  the path of each entry that was set, with the index of every item: "bearing[1].k" for
///           "bearing[right].k"; none, with a problem, where the path leads nowhere
std::vector<std::string> set_entries(Node &root, const std::string &path, std::string_view value,
                                     const Origin &origin, Problems &problems);

} // namespace whirl::input
