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

/// A panel over spin speed with a logarithmic axis of amplitude, where labels are placed.
struct BodePanel {
    Range x; ///< speeds, in their unit
    Range y; ///< amplitudes in theirs
    double pixels_wide = 0, pixels_high = 0;
};

/// Peaks of one station with speed and amplification factor, and their half-power points.
struct PeakMarks {
    std::string name{};   ///< in the legend
    std::string before{}; ///< labels and data, in front of the plot command
    std::string plots{};  ///< elements of the plot command
    std::string after{};  ///< takes away what is not for the next panel, behind it
};
/// @param busy  curves that labels should not lie on, in the units of the panel
[[nodiscard]] PeakMarks peak_marks(const Units &units, const results::HarmonicMotion &result,
                                   std::size_t station, const BodePanel &panel,
                                   const std::vector<NamedCurve> &busy);

/// Whether there is a polar plot: more than one speed, and every amplitude has a limit.
[[nodiscard]] bool has_polar(const results::ResponseResult &result);
/// Polar plot: amplitude over the phase of x, one curve a station over the spin speed; peaks of the
/// largest with their speeds.
[[nodiscard]] Figure polar_figure(const model::Case &scene, const results::ResponseResult &result,
                                  const Units &units);

} // namespace whirl::report
