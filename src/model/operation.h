#pragma once

#include <optional>
#include <string>
#include <vector>

namespace whirl::model {

/// Entries of [operation]: the speeds at which the machine runs.
struct Operation {
    double from = 0;            ///< minimum operating speed, rad/s
    double to = 0;              ///< maximum continuous speed, rad/s
    std::optional<double> trip; ///< at which an independent device shuts down, rad/s
};

/// An impeller or a row of blades whose gas drives the rotor ([[level1.stage]]).
struct Stage {
    std::string name;
    bool axial = false;          ///< a row of blades; else a centrifugal impeller
    double power = 0;            ///< W
    std::optional<double> speed; ///< at which it has that power, rad/s; none: maximum continuous
    double diameter = 0;         ///< of the impeller, or mean diameter of the blades, m
    double width = 0;            ///< least of impeller and diffuser, or height of the blades, m
    double density_ratio = 1;    ///< of the gas behind the impeller over that in front of it
};

/// Entries of [level1]: cross coupling added at one place (docs/theory.md, "Level-I stability").
struct Level1Settings {
    double z = 0;                      ///< m
    std::optional<double> to;          ///< largest cross coupling of the curve, N/m
    int count = 41;                    ///< points of the curve
    std::optional<double> anticipated; ///< of the machine's stages and seals together, N/m
    std::vector<Stage> stages;         ///< from which it is calculated instead
    std::optional<double> gas_density; ///< mean of inlet and outlet, kg/m3
};

} // namespace whirl::model
