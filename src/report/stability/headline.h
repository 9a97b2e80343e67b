#pragma once

#include "report/report.h"
#include "report/stability/band_lines.h"
#include "results/stability.h"

#include <string>
#include <vector>

namespace whirl::report {

// What the answer of `stability` begins with: where something grows, of one speed what becomes of a
// small motion there. Where only some motions are resolved by the elements these are told apart.

[[nodiscard]] std::string headline_text(const results::StabilityResult &result);
[[nodiscard]] std::vector<Section> headline_sections(const results::StabilityResult &result);

/// A table of bands, or that there are none.
[[nodiscard]] std::string bands_text(const std::string &title, const std::vector<BandLine> &bands,
                                     const Columns<BandLine> &shown_columns);
[[nodiscard]] std::string bands_section(const std::vector<BandLine> &bands,
                                        const Columns<BandLine> &shown_columns);

} // namespace whirl::report
