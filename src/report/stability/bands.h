#pragma once

#include "report/common/table.h"
#include "report/report.h"
#include "results/stability.h"

#include <optional>
#include <string>
#include <vector>

namespace whirl::report {

using Bands = std::vector<results::Interval>;
using BandErrors = std::vector<results::EndErrors>;

/// A line of stability.csv. Of a band from and to are its ends; a map has its two entries instead.
struct BandLine {
    std::string kind;
    std::optional<double> from{}, to{};
    std::optional<double> growth{};
    std::string verdict{};
    std::optional<double> from_error{}, to_error{};
    /// Of motions that the elements resolve, where these are told apart, and of faster ones.
    std::optional<double> resolved_growth{}, unresolved_growth{};
    std::string resolved_verdict{};
    std::optional<double> x{}, y{};  ///< of a map
    std::optional<double> log_dec{}; ///< the smallest of the motions
};

/// What the file has, with the growth of what the elements resolve where it is told apart.
[[nodiscard]] Columns<BandLine> file_columns(const results::StabilityResult &result);

/// @param errors  of both ends of each band, or none
[[nodiscard]] std::vector<BandLine> band_lines(const std::string &kind, const Bands &bands,
                                               const BandErrors *errors = nullptr);
[[nodiscard]] std::vector<BandLine> speed_lines(const std::string &kind,
                                                const std::vector<double> &speeds);
[[nodiscard]] std::vector<BandLine> growth_lines(const results::StabilityResult &result);
[[nodiscard]] std::vector<BandLine> map_lines(const results::StabilityMap &map);

// What the answer of `stability` begins with: where something grows, of one speed what becomes of a
// small motion there. Where only some motions are resolved by the elements these are told apart.

/// The same in one sentence.
[[nodiscard]] model::Sentence stability_answer(const results::StabilityResult &result);
[[nodiscard]] std::string headline_text(const results::StabilityResult &result, const Units &units);
[[nodiscard]] std::vector<Section> headline_sections(const results::StabilityResult &result,
                                                     const Units &units);

/// A table of bands, or that there are none. @param errors  of both ends of each; none: not told
[[nodiscard]] std::string bands_text(const std::string &title, const Bands &bands,
                                     const Units &units, const BandErrors *errors = nullptr);
[[nodiscard]] std::string bands_section(const Bands &bands, const Units &units,
                                        const BandErrors *errors = nullptr);

} // namespace whirl::report
