#pragma once

#include "results/sentence.h"

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace whirl::results {

/// A stage and the cross coupling that its gas is expected to have.
struct Level1Stage {
    std::string name;
    bool axial = false;
    double power = 0;                    ///< W
    double speed = 0;                    ///< at which it has that power, rad/s
    double diameter = 0;                 ///< m
    double width = 0;                    ///< m
    std::optional<double> density_ratio; ///< none: of an axial stage
    double cross_coupling = 0;           ///< N/m
};

/// Something that level I asks for.
struct Level1Check {
    std::string name;
    std::optional<double> value; ///< none: `why` says so
    double limit = 0;            ///< passes from there on
    std::optional<bool> passes;  ///< none: not judged, `why` says so
    Sentence why;
};

/// Of the first slow motion, where another one grows first.
struct Level1Judged {
    std::optional<double> critical_cross_coupling; ///< N/m
    std::optional<double> critical_frequency;      ///< rad/s
    std::optional<double> anticipated_log_dec;
};

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
    Sentence no_critical;                      ///< why there is none
    std::optional<double> anticipated;         ///< as in the case, or of its stages together, N/m
    std::optional<double> anticipated_log_dec; ///< with that
    std::vector<Level1Stage> stages;           ///< from which that is calculated
    std::optional<double> gas_density;         ///< as in the case, kg/m3
    /// Maximum continuous speed over the first undamped critical speed on rigid supports; none:
    /// not asked for, or no such critical speed.
    std::optional<double> critical_speed_ratio;
    /// What the checks are of, where not of the numbers above (operation/level1.h).
    std::optional<Level1Judged> judged{};
    std::vector<Level1Check> checks;
    std::optional<bool> level_two; ///< whether an analysis of level II is required; none: unknown
    Sentence verdict;              ///< the same in words
};

} // namespace whirl::results
