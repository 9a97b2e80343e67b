#pragma once

// What a case file consists of, as the oracles see it: SI and radians.

#include "oracles/continuum.h"

#include <array>
#include <string>
#include <vector>

namespace whirl::oracles {

/// A length of the shaft, uniform or a cone.
struct Segment {
    Cylinder left;        ///< with the diameters of the left end
    double outer_end = 0; ///< m
    double inner_end = 0; ///< m
    int elements = 1;
    double asymmetry = 0;       ///< bending stiffnesses EI(1 +- this) of the two directions
    double asymmetry_angle = 0; ///< of the stiffer one, rad
};

/// Diametral inertias Id + dI and Id - dI, kg m2.
struct InertialAnisotropy {
    double z = 0;
    double dI = 0;
    double angle = 0; ///< of the axis of smaller inertia, rad
};

/// Balls of one race, or rings on one journal.
struct Row {
    int n = 0;
    double mass = 0;    ///< of one, kg
    double radius = 0;  ///< of the circle of their centres, m
    double damping = 0; ///< against sliding, N s/m
};

/// n balls (or rows of them), rings, or four pendulums tied in pairs.
struct Balancer {
    double z = 0;
    bool pendulums = false;
    bool ring = false;
    std::vector<Row> rows; ///< of balls and rings; n ... damping below where it is one row of balls
    double bore = 0;       ///< radius of a ring's bore, m
    double inertia = 0;    ///< of a ring about its own axis, kg m2
    double drag = 0;       ///< against a ring's turning in the rotor, N m s
    int n = 0;
    double mass = 0;             ///< of one, kg
    double radius = 0;           ///< of the balls' race, m
    double arm = 0;              ///< of a pendulum, m
    double pivot = 0;            ///< radius of the pendulums' pivots, m
    double damping = 0;          ///< N s/m of a ball, N m s of a pendulum's hinge
    double imbalance = 0;        ///< m0 R0, kg m
    double imbalance_radius = 0; ///< R0, m; 0: the imbalance is no mass of its own
    double diameter = 0;         ///< of a ball, m; 0: not given
    double ellipticity = 0, ellipticity_angle = 0; ///< R (1 + e cos 2(a - angle))
    std::vector<double> walls;                     ///< angles of walls across the race, rad
    bool held = false;                             ///< its parts are fixed in the rotor
    std::vector<double> position; ///< angles from the imbalance, rad; empty: the symmetric ones
};

struct Imbalance {
    double z = 0;
    double mr = 0;    ///< kg m
    double phase = 0; ///< rad
};

/// A force in the fixed frame of one frequency.
struct HarmonicForce {
    double z = 0;
    double amplitude = 0; ///< N
    double phase = 0;     ///< rad
    double multiple = 0;  ///< of the spin speed; 0: a fixed frequency
    double frequency = 0; ///< rad/s
    bool turns = false;   ///< with its frequency; else along x
};

/// What a support has besides stiffness and damping: mass coefficients and a pedestal.
struct Mount {
    Block m{};                             ///< kg
    std::array<double, 2> pedestal_mass{}; ///< x and y, kg
    std::array<double, 2> pedestal_k{};    ///< N/m; 0: no pedestal
    std::array<double, 2> pedestal_c{};    ///< N s/m
    [[nodiscard]] bool empty() const { return m == Block{} && pedestal_k[0] == 0; }
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

/// An axis of [sweep] over one entry.
struct SweptAxis {
    std::string path, change;
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
    bool on_pedestal = false; ///< else it reads the shaft,
    bool relative = false;    ///< against a pedestal
    std::size_t support = 0;  ///< whose pedestal
};

/// [operation] and [level1].
struct Operation {
    double from = 0, to = 0;     ///< rad/s
    double level1_z = 0;         ///< m
    double anticipated = 0;      ///< N/m
    double normal = 0, trip = 0; ///< rad/s; 0: none
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

} // namespace whirl::oracles
