#pragma once

#include "results/balance.h"

#include <string>
#include <utility>
#include <vector>

namespace whirl::report {

/// Headings and HTML below the pictures of the page of balance.
[[nodiscard]] std::vector<std::pair<std::string, std::string>>
balance_sections(const results::BalanceResult &result);

/// JavaScript that draws bands and eigenvalues with Plotly; see html_scripts.h.
extern const char *const balance_script;

} // namespace whirl::report
