#pragma once

#include "report/common/table.h"
#include "results/checks.h"

#include <string>
#include <vector>

namespace whirl::report {

/// The checks of a machine, the same for all readers.
[[nodiscard]] Json checks_json(const std::vector<results::Check> &checks, const Units &units);
[[nodiscard]] std::string checks_csv(const std::vector<results::Check> &checks, const Units &units);
/// HTML, with the result of each in its colour and in words.
[[nodiscard]] std::string checks_page(const std::vector<results::Check> &checks,
                                      const Units &units);
/// For the terminal, at most so many lines; what is left out is counted.
[[nodiscard]] std::string checks_text(const std::vector<results::Check> &checks, std::size_t most,
                                      const Units &units);

} // namespace whirl::report
