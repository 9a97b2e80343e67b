#pragma once

#include <complex>
#include <optional>
#include <string>
#include <vector>

namespace whirl::results {

/// A motion that repeats itself in axes that turn with the rotor, each ball turned on by whole
/// turns.
struct LimitCycle {
    double speed = 0;                    ///< of the rotor, rad/s
    double period = 0;                   ///< s
    double growth = 0;                   ///< of the small motion that grows most, 1/s
    std::optional<bool> stable;          ///< none: neither by more than the errors
    std::vector<std::vector<int>> turns; ///< of the balls of each balancer over a period
    /// Largest and least |w| of each balancer over a period, m.
    std::vector<double> largest, least;
    std::vector<std::complex<double>> multipliers; ///< Floquet's, largest first, but that along it
    double multiplier_error = 0;                   ///< |what was found for that one - 1|
    double defect = 0; ///< what is missing to a return, over the size of the motion
    std::string kind;  ///< along a branch: "fold", "border" of stability, else ""
};

/// A limit cycle that a motion in time ended next to, and what becomes of it over the speed.
struct FoundCycle {
    LimitCycle cycle;
    double away = 0; ///< of the motion from it where it ended, over the size of the motion
    std::vector<LimitCycle> branch;  ///< along the branch; empty: not asked for
    std::string first_end, last_end; ///< how the branch ends: "range", "standing", "points", "lost"
};

} // namespace whirl::results
