#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace whirl::results {

/// A maximum over time: a root of the derivative, or an end of the motion.
struct PeakInTime {
    double value = 0;    ///< m
    double time = 0;     ///< s
    double speed = 0;    ///< of the spin, rad/s
    bool at_end = false; ///< the amplitude still grew at the end of the time
};

/// A station during a motion, beside its steady motions under all imbalances there are at the end.
struct StationMotion {
    double z = 0; ///< m
    std::string name;
    PeakInTime peak;      ///< largest |w| of all times
    double amplitude = 0; ///< largest |w| over the last 2.5 % of the time, m
    /// At the last speed, with balancers without their parts; none: no imbalance, or a resonance
    /// without damping.
    std::optional<double> steady; ///< m
    /// The same with the parts of the balancers fixed where they are at the end; none: no
    /// balancers, or their parts do not stand still in the rotor.
    std::optional<double> with_balls; ///< m
    /// Highest peak of the steady response strictly inside the speeds passed; none: there is none.
    std::optional<double> steady_peak;       ///< m
    std::optional<double> steady_peak_speed; ///< rad/s
};

/// The station that moves most; of those that move alike the one nearest the middle.
[[nodiscard]] std::size_t largest_station(const std::vector<StationMotion> &stations);

/// Steady response over the speeds passed, dense around its peaks.
struct SteadyCurves {
    std::vector<double> speeds;                  ///< rad/s; empty: one speed, or no imbalance
    std::vector<std::vector<double>> amplitudes; ///< of each station, m
};

/// Spectra of one station's motion over windows of time. A spectrum gives at each frequency the
/// largest radius of the orbit that this frequency alone would be: forward plus backward part.
struct Waterfall {
    double z = 0; ///< m
    std::string name;
    double window = 0;                          ///< length of a window, s
    std::vector<double> times;                  ///< middle of each window, s
    std::vector<double> speeds;                 ///< there, rad/s
    std::vector<double> frequencies;            ///< rad/s, ascending from 0
    std::vector<std::vector<double>> amplitude; ///< of each window, over the frequencies, m
};

} // namespace whirl::results
