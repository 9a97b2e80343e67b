#pragma once

#include "report/common/json.h"
#include "report/common/units.h"
#include "report/pictures/chart.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace whirl::report {

/// A result to be compared: what `--json` writes, and what it is called.
struct ComparedResult {
    std::string name;
    Json json;
};

/// A number of a result that others have too.
struct ComparedNumber {
    model::Sentence name; ///< by which it is matched: "critical speed, forward 2"
    Quantity quantity = Quantity::number;
    double value = 0;
    std::optional<double> error; ///< half width of its error bar, in the same unit; none: not known
};

/// One quantity of the first result and of another one.
struct Difference {
    model::Sentence name;
    Quantity quantity = Quantity::number;
    std::string other; ///< name of the other result
    std::optional<double> first_value, other_value;
    std::optional<double> difference; ///< other less first
    std::optional<double> relative;   ///< to the modulus of the first; none where that is 0
    std::optional<double> error;      ///< sum of both error bars
    std::optional<bool> within;       ///< |difference| <= error; none: the errors are not known
};

struct Comparison {
    std::string command; ///< of all results
    std::vector<ComparedResult> results;
    /// Of each result but the first, in the order of the first one.
    std::vector<std::vector<Difference>> differences;
    std::vector<std::string> notes;
};

/// The numbers of a result: critical speeds by whirl and number, whirl frequencies at
/// the first and the last speed by mode, crossings, peaks by place and number, ends of bands by
/// number, masses.
/// @throws model::BadInput for results of commands that have none of these.
[[nodiscard]] std::vector<ComparedNumber> quantities_of(const ComparedResult &result);
/// The i-th of a list of numbers; none where it is missing.
[[nodiscard]] std::optional<double> item(const Json &values, std::size_t i);

/// A result that was written before, of this program and of format 1.
/// @throws model::BadInput
[[nodiscard]] ComparedResult read_result(const std::filesystem::path &file);

/// Every further result against the first, numbers matched by name; what only one has is listed
/// too.
/// @throws model::BadInput for results of different commands, or of one that has nothing to compare
[[nodiscard]] Comparison compare(std::vector<ComparedResult> results);

/// The results over one another (whirl frequencies, response curves, growth or critical speeds over
/// spin speed, where the command has them), and below each relative difference beside its error
/// bar.
[[nodiscard]] Chart comparison_chart(const Comparison &comparison, const Units &units);
/// For the terminal.
[[nodiscard]] std::string comparison_text(const Comparison &comparison, const Units &units);
/// `differences` and what was compared.
[[nodiscard]] Json comparison_json(const Comparison &comparison, const Units &units);
/// Writes compare.json, .csv, .svg, .png and report.html, all or none; returns their paths.
/// @param asked  units that were asked for
std::vector<std::filesystem::path> write_comparison(const Comparison &comparison,
                                                    const std::filesystem::path &folder,
                                                    const model::OutputUnits &asked);

} // namespace whirl::report
