#pragma once

#include <optional>
#include <string>
#include <vector>

namespace whirl::model {

/// An imbalance that comes into being at one moment: a blade or a weight leaves the rotor. Its mass
/// is small against the rotor's, which stays as it is.
struct SuddenImbalance {
    std::string name;
    double z = 0;     ///< m
    double time = 0;  ///< s
    double mr = 0;    ///< mass times radius, kg m
    double phase = 0; ///< direction of the imbalance (opposite to what has left), rad
};

enum class ForceDirection { x, y, forward, backward };

/// A harmonic force on a station in the fixed frame, of a frequency that is a multiple of the spin
/// speed or the same at every one: amplitude cos(frequency t + phase) along x or y, or an amplitude
/// that turns with the frequency in the sense of the spin or against it, at t = 0 at `phase` from x
/// towards y, or towards -y.
struct HarmonicForce {
    std::string name;
    double z = 0;                    ///< m
    double amplitude = 0;            ///< N
    double phase = 0;                ///< rad
    std::optional<double> multiple;  ///< of the spin speed
    std::optional<double> frequency; ///< rad/s; one of the two is there
    ForceDirection direction = ForceDirection::x;
};

/// A force that acts on a station in the fixed frame: x cos(frequency t + phase),
/// y cos(frequency t + phase_y).
struct StationForce {
    std::string name;
    double z = 0;             ///< m
    double x = 0, y = 0;      ///< N
    double frequency = 0;     ///< rad/s; 0: a step
    double phase = 0;         ///< rad
    double phase_y = 0;       ///< rad
    double from = 0;          ///< s
    std::optional<double> to; ///< s; none: to the end

    [[nodiscard]] bool acts_at(double t) const { return t > from && (!to || t < *to); }
};

/// Acceleration of the foundation; deflections count from it.
struct BaseMotion {
    struct Row {
        double time = 0;     ///< s
        double x = 0, y = 0; ///< m/s2
    };
    /// Harmonic, as of a StationForce, m/s2 (z and name mean nothing); none: a table.
    std::optional<StationForce> harmonic;
    std::vector<Row> table; ///< times ascending; linear between, none outside
};

} // namespace whirl::model
