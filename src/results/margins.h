#pragma once

#include "results/whirl.h"

#include <optional>
#include <string>

namespace whirl::results {

/// Where a critical speed lies against the operating speeds.
enum class MarginSide {
    below, ///< the minimum operating speed
    inside,
    above ///< the maximum continuous speed
};

/// "below", "inside" or "above".
[[nodiscard]] std::string margin_side_name(MarginSide side);

/// A critical speed against the operating speeds (operation/margins.h).
struct SeparationMargin {
    double speed = 0;                    ///< rad/s: of the peak, or of the synchronous eigenvalue
    std::optional<Whirl> whirl;          ///< none: a peak that belongs to no critical speed listed
    std::optional<double> plane{};       ///< that of the critical speed (CriticalSpeed), rad
    std::optional<double> amplification; ///< none: without limit
    std::string source;                  ///< of the amplification: "response" or "damping"
    std::string of;                      ///< "station" or "probe", where the peak is; else empty
    std::optional<double> z;             ///< of that place, m
    std::string name;                    ///< of that place
    std::optional<double> angle;         ///< in which the probe there looks, rad
    MarginSide side = MarginSide::inside;
    double found = 0;               ///< % of the end of the range that is nearer; inside 0
    std::optional<double> required; ///< %; none inside: no margin would do
    bool grows = false;             ///< a free motion grows there: it fails whatever was found
    bool passes = false;
};

} // namespace whirl::results
