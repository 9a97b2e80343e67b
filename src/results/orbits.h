#pragma once

#include <optional>
#include <string>
#include <vector>

namespace whirl::results {

/// Orbit at one place at one speed: x(t) = x cos(speed t + x_phase), y(t) likewise.
struct Orbit {
    std::string of; ///< "bearing", "seal": the shaft against what holds it there; "station": all
    double z = 0;   ///< m
    std::string name;
    double x = 0; ///< m
    double x_phase = 0;
    double y = 0;
    double y_phase = 0;
    double major = 0;                ///< semi-axes, m
    double minor = 0;                ///< negative: backward
    std::optional<double> clearance; ///< radial, m
    double error = 0;                ///< estimated, relative to the semi-major axis

    /// Of the clearance that the orbit uses; none: no clearance is known.
    [[nodiscard]] std::optional<double> share() const {
        return clearance ? std::optional(major / *clearance) : std::nullopt;
    }
};

/// Those of one speed: bearings, seals, and all other stations.
struct Orbits {
    double speed = 0; ///< rad/s
    std::vector<Orbit> stations;
};

/// The largest orbit in a clearance over a range of speeds: a peak, or at an end of the range.
struct ClearanceUse {
    std::string of; ///< "bearing" or "seal"
    double z = 0;   ///< m
    std::string name;
    double clearance = 0; ///< radial, m
    double share = 0;     ///< of it; infinite: a resonance without damping
    double speed = 0;     ///< rad/s
    double error = 0;     ///< estimated, relative; NaN: not known
};

/// The bent shaft at one speed, at the instant of the largest deflection along it.
struct DeflectedShape {
    double speed = 0;     ///< rad/s
    double instant = 0;   ///< the angle that the rotor has turned through then, rad
    double largest = 0;   ///< m
    double largest_z = 0; ///< where, m
    std::vector<double> z;
    std::vector<double> x, y;     ///< at that instant, m
    std::vector<double> envelope; ///< semi-major axes of the orbits, m
};

} // namespace whirl::results
