#pragma once

#include "model/excitation.h"
#include "model/operation.h"
#include "model/output_units.h"
#include "model/quantity.h"
#include "model/rotor.h"
#include "model/samples.h"
#include "model/sentence.h"
#include "model/sweep.h"
#include "model/weights.h"

#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace whirl::model {

/// Spin speeds of an analysis, evenly spaced; count == 1 means `from` alone.
struct SpeedRange {
    double from = 0; ///< rad/s
    double to = 0;   ///< rad/s
    int count = 1;

    /// The speeds, ascending, rad/s.
    [[nodiscard]] std::vector<double> values() const {
        std::vector<double> speeds(static_cast<std::size_t>(count), from);
        for (int i = 1; i < count; ++i)
            speeds[static_cast<std::size_t>(i)] =
                i == count - 1 ? to : from + (to - from) * i / (count - 1);
        return speeds;
    }
};

/// Which form of the equations the user forces; see docs/theory.md, "Four forms". In the order of
/// the words of a case file.
enum class FormChoice { automatic, planar, hyperbolic, general, rotating, hill };

/// Entries of [campbell].
struct CampbellSettings {
    int modes = 8;                      ///< whirl modes with the lowest frequencies
    std::vector<double> multiples{1.0}; ///< orders of the spin speed whose crossings are wanted
};

/// Entries of [modes].
struct ModesSettings {
    std::optional<double> speed; ///< spin speed of the shapes, rad/s; none: the first of [speeds]
};

/// Entries of [critical_map].
struct CriticalMapSettings {
    std::optional<double> from;         ///< stiffness, N/m; none: from the rotor
    std::optional<double> to;           ///< N/m
    int points = 61;                    ///< stiffnesses
    std::optional<std::size_t> bearing; ///< place among the supports; none: all together
};

/// A harmonic force at one place, the deflection at another.
struct Receptance {
    double from = 0; ///< z of the force, m
    double to = 0;   ///< z of the deflection, m
};

/// Entries of [response].
struct ResponseSettings {
    double gravity = 0; ///< m/s2 towards -y; 0: the motion under the weight is not asked for
    std::vector<double>
        orbits_at; ///< spin speeds, rad/s; empty: the operating speeds, or the largest peak
    std::vector<double> shape_at;        ///< the same of deflected shapes; empty: as the orbits
    std::vector<Receptance> receptances; ///< at the first speed of the case
    SpeedRange frequencies{};            ///< of their excitation, rad/s
};

/// Entries of [simulate.cycle]: the limit cycle next to the end of the motion.
struct CycleSettings {
    std::optional<SpeedRange> speeds; ///< over which it is followed
};

/// A speed of [simulate.sweep], which the run-up of the settings leads to.
struct HeldSpeed {
    bool up = true;   ///< reached from the speed below
    double speed = 0; ///< rad/s
    double from = 0;  ///< when the rotor has it, s
    double until = 0; ///< until when, s
};

/// Entries of [simulate.starts]: many motions from other angles, told by where they end.
struct StartsSettings {
    bool grid = false;               ///< over two angles; else all are drawn at random
    int count = 0;                   ///< of motions; of a grid in each direction
    int seed = 1;                    ///< of the random numbers
    std::array<int, 2> angles{0, 1}; ///< of a grid: their places among those of all balancers
};

/// Entries of [simulate].
struct SimulateSettings {
    double time = 0;                               ///< s
    std::vector<std::pair<double, double>> run_up; ///< (time s, speed rad/s)
    std::vector<std::vector<double>> ball_angles;  ///< per balancer, rad
    /// Further starts like ball_angles: each is a motion of its own.
    std::vector<std::vector<std::vector<double>>> other_starts;
    double tolerance = 1e-8;      ///< relative, of the integrator
    std::optional<double> torque; ///< N m, of a motor at rest: the spin speed becomes an unknown
    double torque_slope = 0;      ///< N m s: the motor's torque is torque - torque_slope * speed
    double inertia = 0;           ///< kg m2, polar, of what turns with the rotor and is not in it
    double gravity = 0;           ///< m/s2 towards -y
    bool steady_start = false;    ///< in the steady motion at the first speed, instead of at rest
    std::vector<SuddenImbalance> imbalances;
    std::vector<StationForce> forces;
    std::optional<BaseMotion> base;
    int output_points = 2000;           ///< of the time series
    int modes = 0;                      ///< of the shaft that are kept; 0: as many as needed
    double reduction_tolerance = 1e-3;  ///< relative error that keeping few modes may cause
    std::optional<CycleSettings> cycle; ///< empty: none is looked for
    std::filesystem::path restart;      ///< file of an interrupted run to go on from, or empty
    std::optional<StartsSettings> starts;
    std::vector<HeldSpeed> held; ///< of [simulate.sweep], in their order; at the end of `time`
};

/// A four-pendulum balancer in place of another one.
struct PendulumDesign {
    double arm = 0;   ///< m
    double pivot = 0; ///< m
};

/// Entries of [balance].
struct BalanceSettings {
    bool balanced_position = true; ///< whether the real balancers' stability is looked at too
    int simulated = 0; ///< speeds of the range at which the motion in time is computed as well
    std::vector<PendulumDesign> designs;  ///< whose efficiency is drawn beside the case's own
    std::vector<double> external_damping; ///< H for which it is drawn; empty: that of the case
};

/// Entries of [map]: values evenly spaced; without entries the spin speed (`label` "speed").
struct MapSettings {
    SweepAxis x;
    SweepAxis y;
};

/// Entries of [states]: the steady motions in which everything turns with the rotor.
struct StatesSettings {
    std::vector<double> speeds; ///< rad/s; empty: those of [speeds]
    int max_balls = 6;          ///< in one plane, that are searched
};

/// A whole case file.
struct Case {
    std::string name; ///< folder name, or file name without its ending
    std::string title;
    std::filesystem::path file;
    Rotor rotor;
    std::optional<SpeedRange> speeds;               ///< empty where the file has no [speeds]
    FormChoice formulation = FormChoice::automatic; ///< top-level key `formulation`
    std::optional<Operation> operation;             ///< empty: operating speeds not given
    std::optional<Limits> limits;                   ///< empty: none are given
    std::optional<Level1Settings> level1;
    std::optional<StandardSettings> standard; ///< empty: no standard runs
    bool reduction = true; ///< top-level key `reduction`: few shapes where they are enough
    CampbellSettings campbell;
    ModesSettings modes;
    std::optional<CriticalMapSettings> critical_map; ///< empty: no map asked for
    ResponseSettings response;
    SimulateSettings simulate;
    BalanceSettings balance;
    std::optional<StatesSettings> states; ///< empty: not asked for
    std::optional<MapSettings> map;
    std::optional<SamplesSettings> samples;
    std::optional<SweepSettings> sweep;
    std::optional<WeightsSettings> weights;
    OutputUnits units;             ///< of what is written
    std::vector<Sentence> remarks; ///< what of it is no mistake and looks like one
};

/// A case of measurements alone has no shaft: nothing but correction weights can be computed.
[[nodiscard]] inline bool has_shaft(const Case &scene) {
    return !scene.rotor.shaft.segments.empty();
}

/// The spin speeds of a case.
/// @throws BadInput where it has no [speeds].
[[nodiscard]] const SpeedRange &required_speeds(const Case &scene);

/// Least and largest |speed| between two speeds.
[[nodiscard]] std::pair<double, double> range_of_moduli(double from, double to);

} // namespace whirl::model
