#pragma once

#include "report/compare/quantities.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace whirl::report {

/// One quantity of the first result and of another one.
struct Difference {
    std::string quantity;
    std::string unit;
    std::size_t other = 1; ///< place of the other result
    std::optional<double> first_value, other_value;
    std::optional<double> difference; ///< other less first
    std::optional<double> relative;   ///< to the modulus of the first; none where that is 0
    std::optional<double> error;      ///< sum of both error bars
    std::optional<bool> within;       ///< |difference| <= error; none: the errors are not known
};

struct Comparison {
    std::string command; ///< of all results
    std::vector<ComparedResult> results;
    std::vector<Difference> differences; ///< by other result, in the order of the first one
    std::vector<std::string> notes;
};

/// A result that was written before, of this program and of format 1.
/// @throws model::BadInput
[[nodiscard]] ComparedResult read_result(const std::filesystem::path &file);

/// Every further result against the first, numbers matched by name; what only one has is listed
/// too.
/// @throws model::BadInput for results of different commands, or of one that has nothing to compare
[[nodiscard]] Comparison compare(std::vector<ComparedResult> results);

/// For the terminal.
[[nodiscard]] std::string comparison_text(const Comparison &comparison);
/// `differences` and what was compared.
[[nodiscard]] Json comparison_json(const Comparison &comparison);
/// Writes compare.json, .csv, .svg, .png and report.html, all or none; returns their paths.
std::vector<std::filesystem::path> write_comparison(const Comparison &comparison,
                                                    const std::filesystem::path &folder);

} // namespace whirl::report
