#pragma once

#include "report/common/table.h"
#include "results/margins.h"

#include <optional>
#include <string>
#include <vector>

namespace whirl::report {

/// The separation margins of a result, the same in every command that has them; an empty optional
/// is no such part of the result.
using Margins = std::optional<std::vector<results::SeparationMargin>>;

/// Adds the key `margins`.
void add_margins(Json &json, const Margins &margins, const Units &units);
/// HTML below a heading.
[[nodiscard]] std::string margins_page(const std::vector<results::SeparationMargin> &margins,
                                       const Units &units);
/// For the terminal, with its heading; empty without margins.
[[nodiscard]] std::string margins_text(const Margins &margins, const Units &units);

inline constexpr const char *margins_heading = "Separation margins (API 617)";

} // namespace whirl::report
