#pragma once

#include <string>

namespace whirl::model {

/// Rotating inertial anisotropy at z: diametral inertias Id + dI and Id - dI about two
/// perpendicular axes that turn with the rotor.
struct Anisotropy {
    std::string name;
    double z = 0;     ///< m
    double dI = 0;    ///< kg m2
    double angle = 0; ///< direction of the axis of smaller inertia in the rotor, rad
};

/// A correction plane for the empirical criterion.
struct CorrectionPlane {
    std::string name;
    double z = 0; ///< m
};

/// A displacement sensor beside the shaft, which does not turn: it reads x cos(angle) + y
/// sin(angle).
struct Probe {
    std::string name;
    double z = 0;     ///< m
    double angle = 0; ///< direction in which it looks, from x towards y, rad
};

/// A small static imbalance fixed in the rotor.
struct Imbalance {
    std::string name;
    double z = 0;     ///< m
    double mr = 0;    ///< mass times radius, kg m
    double phase = 0; ///< rad
};

} // namespace whirl::model
