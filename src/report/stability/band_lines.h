#pragma once

#include "report/common/table.h"
#include "results/stability.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace whirl::report {

using SpeedPairs = std::vector<std::pair<double, double>>;

/// A line of stability.csv. Of a band from and to are its ends; of a map they are its two entries.
struct BandLine {
    std::string kind;
    double from = 0, to = 0;
    std::optional<double> growth{};
    std::string verdict{};
    std::optional<std::pair<double, double>> errors{};
    /// Of motions that the elements resolve, where these are told apart, and of faster ones.
    std::optional<double> resolved_growth{}, unresolved_growth{};
    std::string resolved_verdict{};
};

/// Lines of the file, and of the tables of bands.
[[nodiscard]] const Columns<BandLine> &band_line_columns();
/// The same with the errors of both ends.
[[nodiscard]] Columns<BandLine> band_columns_with_errors();
/// All that the file has, with the growth of what the elements resolve where it is told apart.
[[nodiscard]] Columns<BandLine> file_columns(const results::StabilityResult &result);

/// @param errors  of both ends of each band, or none
[[nodiscard]] std::vector<BandLine> band_lines(const std::string &kind, const SpeedPairs &bands,
                                               const SpeedPairs &errors = {});
[[nodiscard]] std::vector<BandLine> speed_lines(const std::string &kind,
                                                const std::vector<double> &speeds);
[[nodiscard]] std::vector<BandLine> growth_lines(const results::StabilityResult &result);
[[nodiscard]] std::vector<BandLine> map_lines(const results::StabilityMap &map);

} // namespace whirl::report
