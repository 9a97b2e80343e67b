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

} // namespace whirl::input
