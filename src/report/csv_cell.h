#pragma once

#include <optional>
#include <string>
#include <vector>

namespace whirl::report {

/// A number with all its digits; empty for what is missing or not finite.
[[nodiscard]] std::string csv_cell(std::optional<double> value);

/// Text; quoted where a comma, a quote or a line end would break the row.
[[nodiscard]] std::string csv_cell(const std::string &text);

/// An entry of a list; empty beyond its end.
[[nodiscard]] std::string csv_cell(const std::vector<double> &values, std::size_t i);

} // namespace whirl::report
