#pragma once

#include "model/quantity.h"
#include "results/sentence.h"

#include <optional>
#include <string>
#include <vector>

namespace whirl::results {

/// What one place does at one operating speed. Amplitudes from zero to peak; those of motions of
/// several frequencies are added up, as if their peaks came together.
struct OperatingRow {
    double speed = 0; ///< rad/s
    std::string at;   ///< "minimum", "normal", "maximum" or "trip"
    std::string of;   ///< "probe", "bearing", "seal", "pedestal" or "station"
    std::string name;
    double z = 0;                ///< m
    std::optional<double> angle; ///< in which a probe looks, rad
    bool relative = false;       ///< the shaft against what holds it there
    double amplitude = 0;        ///< m; infinite: a resonance without damping
    double phase = 0;            ///< of x or of the reading at the spin speed, rad; NaN: none
    double velocity = 0;         ///< amplitude, m/s
    double acceleration = 0;     ///< amplitude, m/s2
    std::optional<double> clearance_share; ///< of a bearing or seal with a clearance
    std::optional<double> force;           ///< of a bearing or seal, N
    std::optional<double> limit;           ///< of `limited`, in SI
    std::string limited;      ///< "amplitude", "velocity" or "velocity rms"; else empty
    std::optional<bool> pass; ///< none: there is no limit, or it is not judged
    double error = 0;         ///< estimated, relative to the amplitude; NaN: not known
};

/// The largest value of a place over a range of speeds, against its limit, which may change with
/// the speed: where it is nearest to it or farthest above.
struct OperatingWorst {
    std::string of, name; ///< as in OperatingRow
    double z = 0;
    std::optional<double> angle;
    bool relative = false;
    std::string what; ///< "amplitude", "velocity rms", "velocity", "clearance share"
    model::Quantity quantity = model::Quantity::number;
    double from = 0, to = 0;     ///< the range, rad/s
    double speed = 0;            ///< where, rad/s
    double value = 0;            ///< there; infinite: a resonance without damping
    std::optional<double> limit; ///< there
    double error = 0;            ///< estimated, relative; NaN: not known
    std::string source;          ///< of the limit
    Sentence why;                ///< it cannot be judged; empty: it can
};

/// The machine at its operating speeds.
struct OperatingResponse {
    std::vector<OperatingRow> rows; ///< by speed, then by place
    std::vector<OperatingWorst> worst;
    /// By which the imbalance is multiplied for clearances; none: none are asked for, or it is not
    /// known.
    std::optional<double> scale;
};

} // namespace whirl::results
