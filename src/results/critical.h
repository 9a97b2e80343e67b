#pragma once

#include "results/damping.h"
#include "results/error_parts.h"
#include "results/interval.h"
#include "results/margins.h"
#include "results/model_summary.h"
#include "results/whirl.h"

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace whirl::results {

struct CriticalSpeed {
    double speed = 0; ///< rad/s; negative where the rotor spins from y to x
    Whirl whirl = Whirl::forward;
    double real = 0;  ///< 1/s, of the synchronous eigenvalue
    double error = 0; ///< relative estimate
    double residual = 0;
    Damping damping;  ///< of the synchronous eigenvalue; empty: the speed is that without damping
    std::string mode; ///< name of its line in the Campbell diagram; empty: not known
    ErrorParts error_parts{}; ///< of `error`
    /// In which all orbits nearly lie as lines, from x towards y, rad; none: they are ellipses.
    std::optional<double> plane{};
};

/// The n-th critical speed of a sense of whirl over the stiffness of the supports.
struct CriticalMapCurve {
    Whirl whirl = Whirl::forward;
    int number = 1;            ///< n, from 1
    std::vector<double> speed; ///< rad/s, over CriticalMap::stiffness; NaN: there is none
    std::vector<double> error; ///< relative estimates; infinite: not known
    // Deflections at the softest and the stiffest supports, at CriticalMap::z, largest 1; empty:
    // there is no such critical speed.
    std::vector<double> soft;
    std::vector<double> stiff;
};

/// Bearings of equal coefficients, whose stiffness is laid across the map.
struct CriticalMapBearing {
    std::vector<std::size_t> bearings; ///< places among the supports of the rotor
    bool isotropic = true;             ///< kxx = kyy at every speed
    std::vector<double> speeds;        ///< rad/s, ascending
    std::vector<double> kxx;           ///< N/m, at these speeds
    std::vector<double> kyy;
};

/// Where the stiffness of a bearing, as it is at that speed, meets a curve.
struct CriticalMapCrossing {
    std::size_t bearing = 0; ///< place in CriticalMap::bearings
    std::string of;          ///< "k" (isotropic), "kxx", "kyy"
    double speed = 0;        ///< rad/s
    double stiffness = 0;    ///< N/m
    Whirl whirl = Whirl::forward;
    int number = 1;   ///< of the curve
    double error = 0; ///< of the speed, relative; infinite: not known
};

/// Critical speeds without damping over the isotropic stiffness of the supports.
struct CriticalMap {
    std::optional<std::size_t> bearing;   ///< whose stiffness varies; none: that of all supports
    std::vector<double> stiffness;        ///< N/m, ascending, evenly spaced in its logarithm
    std::vector<CriticalMapCurve> curves; ///< forward ones first, by number
    std::vector<double> z;                ///< m, of the deflections
    std::vector<CriticalMapBearing> bearings;
    std::vector<CriticalMapCrossing> crossings; ///< by bearing and direction, then by speed
};

struct CriticalResult {
    ModelSummary model;
    std::vector<CriticalSpeed> critical_speeds; ///< ascending
    /// Where none is missing, rad/s; an end is infinite where the model has no more, and 0 where
    /// those of its sign are not wanted.
    Interval complete{0, std::numeric_limits<double>::infinity()};
    std::vector<Interval> doubtful; ///< where some may be missing all the same, rad/s
    /// Where the case has operating speeds; ascending, without those of AF < 2.5.
    std::optional<std::vector<SeparationMargin>> margins;
    std::optional<CriticalMap> map; ///< where it was asked for
};

} // namespace whirl::results
