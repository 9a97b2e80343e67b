#pragma once

#include "results/show.h"

#include <string>

namespace whirl::cli {

/// What the balancers add and the anisotropy does, for the terminal; empty without either.
[[nodiscard]] std::string rotating_parts_text(const results::ShowResult &result);

} // namespace whirl::cli
