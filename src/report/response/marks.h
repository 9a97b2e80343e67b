#pragma once

#include "model/case.h"
#include "report/common/gnuplot.h"
#include "report/pictures/style.h"
#include "results/response.h"

#include <optional>
#include <string>
#include <vector>

namespace whirl::report {

/// The station whose orbit is largest anywhere in the range; none without stations. A resonance
/// without damping counts as larger than all.
[[nodiscard]] std::optional<std::size_t> largest_station(const results::HarmonicMotion &result);

/// The peaks of a place that have a size.
[[nodiscard]] std::vector<const results::ResponsePeak *>
labelled_peaks(const results::HarmonicMotion &result, std::size_t place,
               const std::string &of = "station");

/// "2951 rpm, AF 12.3": of its resonance; "3100 rpm, flank": it is none.
[[nodiscard]] std::string peak_text(const Units &units, const results::ResponsePeak &peak,
                                    const std::vector<results::Resonance> &resonances);

/// Whether there is a polar plot: more than one speed, and every amplitude has a limit.
[[nodiscard]] bool has_polar(const results::ResponseResult &result);
/// Polar plot: amplitude over the phase of x, one curve a station over the spin speed; peaks of the
/// largest with their speeds.
[[nodiscard]] Chart polar_chart(const model::Case &scene, const results::ResponseResult &result,
                                const Units &units);

} // namespace whirl::report
