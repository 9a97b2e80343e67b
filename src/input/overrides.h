#pragma once

#include "input/node.h"

#include <string>
#include <vector>

namespace whirl::input {

/// Applies overrides "path.to.key=value" to a case in their order. Missing keys and tables are
/// made; an item of a list must exist. Mistakes are named "--set path.to.key=value".
void apply_overrides(Node &root, const std::vector<std::string> &overrides, Problems &problems);

} // namespace whirl::input
