#pragma once

#include "model/quantity.h"
#include "results/sentence.h"

#include <optional>
#include <string>
#include <vector>

namespace whirl::results {

/// What a limit is of.
enum class Measure {
    amplitude,     ///< of a displacement
    amplitude_rms, ///< root mean square of it
    velocity,      ///< amplitude
    velocity_rms,
    clearance_share ///< amplitude over radial clearance
};
/// "amplitude", "amplitude rms", "velocity", "velocity rms" or "clearance share".
[[nodiscard]] std::string measure_name(Measure measure);
[[nodiscard]] model::Quantity measure_quantity(Measure measure);

/// Where something is looked at while the machine runs.
struct OperatingPlace {
    std::string of; ///< "probe", "bearing", "seal", "pedestal" or "station"
    std::string name;
    double z = 0;                ///< m
    std::optional<double> angle; ///< in which a probe looks, rad
    /// The shaft against what holds it there; else a motion in the fixed frame.
    bool relative = false;
};

/// What one place does at one operating speed. Amplitudes are semi-major axes or readings, from
/// zero to peak; those of motions of several frequencies are added up, as if their peaks came
/// together. Infinite: a resonance without damping.
struct OperatingRow : OperatingPlace {
    double speed = 0;        ///< rad/s
    std::string at;          ///< "minimum", "normal", "maximum", "trip", or several of them
    double amplitude = 0;    ///< m
    double phase = 0;        ///< of x or of the reading under the imbalances, rad; NaN: none
    double velocity = 0;     ///< amplitude, m/s
    double acceleration = 0; ///< amplitude, m/s2
    std::optional<double> clearance_share;
    std::optional<double> force; ///< of a bearing or seal, N
    double error = 0;            ///< estimated, relative to the amplitude; NaN: not known

    // Of the limits of this place the one that is used most.
    std::optional<Measure> limited;
    double value = 0;            ///< what is limited
    std::optional<double> limit; ///< in SI
    std::optional<bool> pass;    ///< none: there is no limit, or it is not judged
};

/// The largest value of a place over a range of speeds, against a limit.
struct OperatingWorst : OperatingPlace {
    Measure what = Measure::amplitude;
    double from = 0, to = 0; ///< the range, rad/s
    double speed = 0;        ///< where, rad/s
    double value = 0;        ///< there; infinite: a resonance without damping
    double limit = 0;
    double error = 0;         ///< estimated, relative; NaN: not known
    double scale = 1;         ///< by which the imbalance was multiplied for it
    std::string source;       ///< of the limit
    std::optional<bool> pass; ///< none: not judged
    Sentence why;             ///< it is not judged
};

/// The machine at its operating speeds.
struct OperatingResponse {
    std::vector<OperatingRow> rows;    ///< by speed, then by place
    std::vector<OperatingWorst> worst; ///< by limit, then by place
    /// By which the imbalance is multiplied for clearances, so that the probe that reads most is at
    /// its limit; none: not asked for or not known.
    std::optional<double> scale;
    Sentence no_scale; ///< why it is not known
};

} // namespace whirl::results
