#pragma once

#include <string>
#include <vector>

namespace whirl::report {

/// What stands on the terminal, in so many lines: the answer, which comes first, keeps its rows as
/// long as it can; tables further down lose theirs first, then their place. Lines that begin with
/// two blanks are tables, the first line of each its head; a line "… 12 more rows" stands where
/// some were left out. Notes that find no place are counted.
/// @param lines  at most; 0: all there is
/// @param last   where the rest is; empty: nothing
[[nodiscard]] std::string fitted_text(const std::string &body,
                                      const std::vector<std::string> &notes,
                                      const std::string &last, int lines);

} // namespace whirl::report
