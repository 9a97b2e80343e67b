#pragma once

#include "oracles/case_parts.h"

#include <string>
#include <vector>

namespace whirl::oracles {

/// What the oracles take from a case file: SI and radians.
struct CaseRotor {
    std::vector<Segment> shaft;
    bool rigid = false;
    bool classical = false;     ///< order = 1: two-node elements
    double axial_force = 0;     ///< N, tension positive
    double axial_torque = 0;    ///< N m
    std::string torque_kind;    ///< empty: axial
    bool rotary_inertia = true; ///< of the shaft's sections
    double internal_damping = 0;
    std::vector<RigidDisc> discs;  ///< the fluid of seals among them: point masses
    std::vector<Support> supports; ///< as they are at rest
    std::vector<SpeedTable> tables;
    /// Of the bearings with [standard] clearances, in the order of the case; empty without.
    std::vector<std::vector<SpeedTable>> tables_of_clearances;
    std::vector<Mount> mounts; ///< of each support
    std::vector<InertialAnisotropy> anisotropies;
    std::vector<Balancer> balancers;
    std::vector<double> planes; ///< m; the balancers' where the case has none
    std::vector<Imbalance> imbalances;
    std::vector<HarmonicForce> forces;
    double speed_from = 0; ///< rad/s
    double speed_to = 0;   ///< rad/s
    int speed_count = 1;
    std::vector<PendulumDesign> designs;
    std::vector<double> external_dampings; ///< H of [balance]
    double gravity = 0;                    ///< m/s2, of [response]
    std::vector<double> frequencies;       ///< rad/s, of receptances
    double time = 0;                       ///< s, of [simulate]
    RunUp run_up;
    std::vector<std::vector<double>> ball_angles; ///< at the start, one list a balancer
    std::vector<std::vector<std::vector<double>>> other_starts;
    std::vector<double> held; ///< rad/s, speeds of [simulate.sweep] in the order of time
    SampledCase samples;
    std::vector<SweptAxis> sweep;
    std::vector<Probe> probes;
    Operation operation;

    [[nodiscard]] double length() const;
    [[nodiscard]] bool damped() const;
    /// Supports with mass coefficients or pedestals: answers_mounted alone knows of them.
    [[nodiscard]] bool mounted() const;
    /// Rings or several rows of balls: answers_carried alone knows of them.
    [[nodiscard]] bool rings_or_rows() const;
    /// Speed i of the grid, rad/s.
    [[nodiscard]] double speed(int i) const;
    /// The same rotor with the bearings' coefficients at a speed (rad/s).
    [[nodiscard]] CaseRotor at_speed(double speed) const;
};

/// Reads a case file with settings such as "bearing[0].c=0" over it. Throws std::runtime_error.
[[nodiscard]] CaseRotor read_case(const std::string &file,
                                  const std::vector<std::string> &settings);

/// The exact continuum of it; a cone as so many uniform slices with the diameters of their middles.
[[nodiscard]] SteppedRotor stepped(const CaseRotor &rotor, int slices = 1);

} // namespace whirl::oracles
