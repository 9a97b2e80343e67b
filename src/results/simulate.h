#pragma once

#include "model/restart.h"
#include "results/held_motion.h"
#include "results/limit_cycle.h"
#include "results/model_summary.h"
#include "results/transient.h"

#include <optional>
#include <string>
#include <vector>

namespace whirl::results {

/// How a motion ended.
enum class Outcome {
    balanced,  ///< all stands still in the rotor and little of the unbalanced amplitude is left
    offset,    ///< all stands still in the rotor, which is not balanced
    lagging,   ///< balls turn slower (or faster) than the rotor
    whirling,  ///< balls or pendulums swing in the rotor without end
    growing,   ///< the motion grows steadily, wherever it may end
    steady,    ///< without balancers: the amplitudes stay as they are
    transient, ///< without balancers: speed or amplitudes still change
    undecided  ///< the motion still changes, or what it looks like cannot last
};

/// "balanced", "offset", "lagging", "whirling", "growing", "undecided"; "steady", "transient".
[[nodiscard]] std::string outcome_name(Outcome outcome);

/// Over the output times.
struct MotionSeries {
    std::vector<double> time;  ///< s
    std::vector<double> speed; ///< rad/s
    /// For each plane: largest |w| since the output time before, m; deflections at the time, m.
    std::vector<std::vector<double>> amplitude, x, y;
    std::vector<std::vector<double>> angles; ///< for each ball or pair, in the rotor, rad, whole
    /// With balancers: largest |w| of all stations since the output time before, m.
    std::vector<double> stations;
};

/// The steady motion with the parts of all balancers fixed in the rotor where they are at the end.
struct PartsAtRest {
    double amplitude = 0; ///< largest of planes and stations, m
    double halfway = 0;   ///< the same where they were after half the time, m
    // Of balls and rings that nothing but the whirl moves along their circles; none: other parts,
    // or parts that touch or resist.
    std::optional<double> away; ///< angle of the farthest from where they would rest, rad
    std::optional<bool> holds;  ///< no slow motion about where they are grows
    // What is left in the rotor about its centre of mass.
    double center_of_mass = 0; ///< z, m
    double imbalance = 0;      ///< kg m
    double couple = 0;         ///< kg m2
};

/// A balancer at the end of the motion.
struct BalancerMotion {
    double z = 0; ///< m
    std::string name;
    std::string kind;                     ///< as in the case: "ball", "pendulum4", "ring"
    std::vector<std::string> coordinates; ///< names of its angles
    std::optional<double> capacity;       ///< E = n m R / (m0 R0), where it has an imbalance
    std::vector<double> angles;           ///< in the rotor, (-pi, pi], rad; one a coordinate
    std::vector<double> rates;            ///< mean over the last tenth of the time, rad/s
    std::vector<double> swing;            ///< greatest less least angle over the same window, rad
    double amplitude = 0;                 ///< largest |w| over the last 2.5 % of the time, m
    double reference = 0;                 ///< largest |w| of the steady motion without balls, m
};

/// How well energy and angular momentum were kept: what is missing in the books.
struct MotionAudit {
    double energy_error = 0;   ///< J
    double energy_scale = 0;   ///< J, largest of work, loss and change of energy
    double momentum_error = 0; ///< kg m2/s
    double momentum_scale = 0; ///< kg m2/s, largest of impulse and change of momentum
    double impact_gain = 0;    ///< largest share of the energy that an impact created: rounding
};

/// A motion from another start, told by its end.
struct OtherStart {
    std::vector<double> start_angles; ///< of all balls and pairs, rad
    Outcome outcome = Outcome::whirling;
    Sentence evidence;
    std::optional<double> residual_ratio;
    std::vector<std::vector<double>> angles; ///< final ones of each balancer, rad
    std::vector<double> amplitude;           ///< over the output times, largest of the planes, m
};

struct SimulateResult {
    ModelSummary model;
    Outcome outcome = Outcome::whirling;
    Sentence evidence; ///< the numbers behind the outcome, for readers
    std::optional<double> residual_ratio;
    /// The same of the stations: largest amplitude left over the largest without balls.
    std::optional<double> station_ratio;
    double station_reference = 0;       ///< that without balls, m; 0: not known
    std::optional<PartsAtRest> at_rest; ///< none: no balancers, or their parts do not stand still
    /// Rate at which the amplitude grows over the last half of the time, 1/s; none where the speed
    /// changes.
    std::optional<double> trend;
    /// Largest real part of the balanced position's eigenvalues at the last speed, 1/s; none where
    /// there is no such position (linear_growth.h) or the speed changes.
    std::optional<double> linear_growth;
    /// Time of the motion, s, with which an undecided outcome would be known.
    std::optional<double> decision_time;
    double time = 0;        ///< s, at the end
    double speed = 0;       ///< rad/s, at the end
    double revolutions = 0; ///< from the start
    std::vector<BalancerMotion> balancers;
    std::optional<long> impacts; ///< between balls that do not pass each other or resist rolling
    MotionSeries series;
    std::vector<double> start_angles; ///< of all balls and pairs, rad
    std::vector<OtherStart> other_starts;
    std::optional<FoundCycle> cycle;  ///< none: not asked for, or a note says why
    std::optional<HeldSweep> sweep;   ///< over the speeds of [simulate.sweep]
    std::optional<ManyStarts> starts; ///< of [simulate.starts]
    /// Wherever something is attached. Without balancers the series are theirs, in this order.
    std::vector<StationMotion> stations;
    SteadyCurves steady;
    std::optional<Waterfall> waterfall;

    int modes = 0;              ///< lowest modes among the shapes
    int shapes = 0;             ///< planar shapes the shaft moves in
    double response_error = 0;  ///< relative, by the reduction
    double frequency_error = 0; ///< relative, by the reduction
    std::string integrator;
    long steps = 0;
    long rate_evaluations = 0;
    MotionAudit audit;

    /// Set where the run was interrupted: the rest of this result is that of the part done.
    std::optional<model::Restart> restart;
};

} // namespace whirl::results
