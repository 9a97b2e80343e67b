#pragma once

#include <limits>
#include <optional>
#include <vector>

namespace whirl::results {

/// Stability at the maximum continuous speed with cross coupling kxy = q, kyx = -q added at one
/// place (operation/level1.h).
struct Level1 {
    double z = 0;                  ///< m
    double speed = 0;              ///< rad/s
    std::vector<double> q;         ///< N/m, ascending from 0
    std::vector<double> log_dec;   ///< of the motion that begins to grow first
    std::vector<double> frequency; ///< of the same, rad/s
    /// With which that motion stops dying out, N/m; none: it grows without, or never does.
    std::optional<double> critical_cross_coupling;
    /// Relative, of the latter, estimated by finer elements; NaN: not known.
    double error = std::numeric_limits<double>::quiet_NaN();
    std::optional<double> critical_frequency;  ///< of the motion there, rad/s
    std::optional<double> anticipated;         ///< as in the case, N/m
    std::optional<double> anticipated_log_dec; ///< with that
};

} // namespace whirl::results
