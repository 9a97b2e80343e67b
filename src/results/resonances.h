#pragma once

#include "results/response.h"

#include <optional>
#include <vector>

namespace whirl::results {

/// Peaks of one resonance each: two of one place never, for two peaks of one curve are two
/// resonances; nor two of different modes, where both are known. The others are of one where they
/// are apart by less than its width, measured by the amplification factors: each with the nearest.
/// Stations first, then probes, then bearings; the largest value of the first kind leads.
[[nodiscard]] std::vector<std::vector<const ResponsePeak *>>
of_one_resonance_each(std::vector<const ResponsePeak *> peaks);

/// Whether two speeds are apart by less than the width of the wider of two resonances.
/// @param factor,other_factor  amplification factors, where they are known
[[nodiscard]] bool within_width(double speed, std::optional<double> factor, double other_speed,
                                std::optional<double> other_factor);

/// Says of each peak what it is and of which resonance, and lists the resonances, ascending.
/// @param peaks  of one motion; `kind` and `resonance` are set
[[nodiscard]] std::vector<Resonance> resonances_of(std::vector<ResponsePeak> &peaks);

} // namespace whirl::results
