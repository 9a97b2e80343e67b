#pragma once

#include "oracles/continuum.h"

#include <string>
#include <vector>

namespace whirl::oracles {

/// A length of the shaft, uniform or a cone.
struct Segment {
    Cylinder left;        ///< with the diameters of the left end
    double outer_end = 0; ///< m
    double inner_end = 0; ///< m
    int elements = 1;
    double asymmetry = 0; ///< bending stiffnesses EI(1 +- this) of the two directions
};

/// Diametral inertias Id + dI and Id - dI, kg m2.
struct InertialAnisotropy {
    double z = 0;
    double dI = 0;
    double angle = 0; ///< of the axis of smaller inertia, rad
};

/// n balls, or four pendulums tied in pairs.
struct Balancer {
    double z = 0;
    bool pendulums = false;
    int n = 0;
    double mass = 0;             ///< of one, kg
    double radius = 0;           ///< of the balls' race, m
    double arm = 0;              ///< of a pendulum, m
    double pivot = 0;            ///< radius of the pendulums' pivots, m
    double damping = 0;          ///< N s/m of a ball, N m s of a pendulum's hinge
    double imbalance = 0;        ///< m0 R0, kg m
    double imbalance_radius = 0; ///< R0, m; 0: the imbalance is no mass of its own
};

struct Imbalance {
    double z = 0;
    double mr = 0;    ///< kg m
    double phase = 0; ///< rad
};

/// Coefficients of a bearing at some speeds; linear between, constant outside.
struct SpeedTable {
    std::vector<double> speeds; ///< rad/s, ascending; none: coefficients do not depend on the speed
    std::vector<Support> rows;
};

/// Arm and pivot of a design in [balance], m.
struct PendulumDesign {
    double arm = 0;
    double pivot = 0;
};

/// An entry that [samples] varies.
struct UncertainEntry {
    std::string path, distribution;
    double mean = 0, deviation = 0; ///< without a mean in the case: nan
    bool relative = false;
    double from = 0, to = 0;
    std::vector<double> values;
};

/// What [samples] says.
struct SampledCase {
    int count = 0;
    int seed = 1;
    std::vector<double> quantiles;
    std::vector<UncertainEntry> vary;
};

/// A sensor that looks along `angle`, rad.
struct Probe {
    double z = 0;
    double angle = 0;
};

/// [operation] and [level1].
struct Operation {
    double from = 0, to = 0; ///< rad/s
    double level1_z = 0;     ///< m
    double anticipated = 0;  ///< N/m
};

/// An imbalance from a moment on.
struct SuddenImbalance {
    Imbalance imbalance;
    double time = 0; ///< s
};

/// Of [simulate]: run_up = {from, to, duration}.
struct RunUp {
    double from = 0, to = 0; ///< rad/s
    double duration = 0;     ///< s; 0: constant speed
    bool steady_start = false;
    std::vector<SuddenImbalance> sudden;
};

/// What the oracles take from a case file: SI and radians.
struct CaseRotor {
    std::vector<Segment> shaft;
    bool rigid = false;
    bool classical = false; ///< order = 1: two-node elements
    double axial_force = 0; ///< N, tension positive
    double internal_damping = 0;
    std::vector<RigidDisc> discs;  ///< the fluid of seals among them: point masses
    std::vector<Support> supports; ///< as they are at rest
    std::vector<SpeedTable> tables;
    std::vector<InertialAnisotropy> anisotropies;
    std::vector<Balancer> balancers;
    std::vector<double> planes; ///< m; the balancers' where the case has none
    std::vector<Imbalance> imbalances;
    double speed_from = 0; ///< rad/s
    double speed_to = 0;   ///< rad/s
    int speed_count = 1;
    std::vector<PendulumDesign> designs;
    std::vector<double> external_dampings; ///< H of [balance]
    double gravity = 0;                    ///< m/s2, of [response]
    double time = 0;                       ///< s, of [simulate]
    RunUp run_up;
    std::vector<std::vector<double>> ball_angles; ///< at the start, one list a balancer
    std::vector<std::vector<std::vector<double>>> other_starts;
    SampledCase samples;
    std::vector<Probe> probes;
    Operation operation;

    [[nodiscard]] double length() const;
    [[nodiscard]] bool damped() const;
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
