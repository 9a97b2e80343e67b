#pragma once

#include <string>
#include <vector>

namespace whirl::results {

/// Of a station under the weight: where the shaft stands, and how its section is turned there.
struct SagStation {
    double z = 0;
    std::string name;       ///< of what is attached there, or empty
    double x = 0, y = 0;    ///< deflection, m; the weight acts along -y
    double slope_x = 0;     ///< rotation of the section in the plane z-x, rad
    double slope_y = 0;     ///< in the plane z-y; without shear dy/dz
    double error = 0;       ///< estimated, relative to the size of the deflection
    double slope_error = 0; ///< the same of the slope
};

/// What the shaft lays on a bearing.
struct SagBearing {
    double z = 0;
    std::string name;
    double load = 0;  ///< downwards, N; negative: the shaft pulls it up
    double side = 0;  ///< along x, N
    double error = 0; ///< estimated, relative to the size of both
};

/// A rotor at rest under the weight of shaft and discs.
struct StaticSag {
    double gravity = 0; ///< m/s2 along -y
    std::vector<SagStation> stations;
    std::vector<SagBearing> bearings;
};

} // namespace whirl::results
