#pragma once

#include "results/show.h"

#include <string>
#include <utility>
#include <vector>

namespace whirl::report {

/// Headings and tables of the balancers and of the anisotropy, for the page of show.
[[nodiscard]] std::vector<std::pair<std::string, std::string>>
show_sections(const results::ShowResult &result);

} // namespace whirl::report
