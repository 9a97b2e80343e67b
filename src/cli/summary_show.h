#pragma once

#include "analyses/results.h"

#include <string>

namespace whirl::cli {

/// What the balancers add and the anisotropy does, for the terminal; empty without either.
[[nodiscard]] std::string rotating_parts_text(const analyses::ShowResult &result);

} // namespace whirl::cli
