#pragma once

#include <optional>

namespace whirl::model {

/// Entries of [operation]: the speeds at which the machine runs.
struct Operation {
    double from = 0;            ///< minimum operating speed, rad/s
    double to = 0;              ///< maximum continuous speed, rad/s
    std::optional<double> trip; ///< at which an independent device shuts down, rad/s
};

/// Entries of [level1]: cross coupling added at one place (docs/theory.md, "Level-I stability").
struct Level1Settings {
    double z = 0;                      ///< m
    std::optional<double> to;          ///< largest cross coupling of the curve, N/m
    int count = 41;                    ///< points of the curve
    std::optional<double> anticipated; ///< of the machine's stages and seals together, N/m
};

} // namespace whirl::model
