#pragma once

#include "results/interval.h"
#include "results/model_summary.h"
#include "results/pendulum.h"
#include "results/steady_states.h"

#include <complex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace whirl::results {

/// An end of a band inside the range of speeds, beside the nearest end of the rigid closed form.
struct BandEnd {
    double speed = 0;                          ///< rad/s
    bool upper = false;                        ///< the band ends here; else it begins here
    std::optional<double> rigid;               ///< rad/s
    std::optional<double> relative_difference; ///< speed / rigid - 1
    std::optional<double> error;               ///< rad/s; none where it is not known
    std::optional<double> pinned;              ///< the same end as a pinned critical speed, rad/s
    /// One plane of a rotor that is not axisymmetric: the imbalances that are the last to be
    /// balanced or the first not to be; rad in the rotor from x towards y, -pi/2 .. pi/2.
    std::optional<double> direction;
};

/// Errors of both ends of a band, rad/s; 0 at an end of the range, none where not known.
using KnownErrors = std::pair<std::optional<double>, std::optional<double>>;

/// Where one plane alone, or all of them together, can balance the rotor.
struct BalanceBands {
    std::vector<Interval> bands;                      ///< of the rotor of the case
    std::optional<std::vector<Interval>> rigid_bands; ///< closed form; none where it has no form
    std::vector<double> pinned; ///< forward critical speeds of the rotor pinned there, rad/s
    std::vector<BandEnd> ends;
    std::vector<KnownErrors> errors; ///< of each band
};

struct BalancePlane {
    std::string name;
    double z = 0; ///< m
    BalanceBands bands;
    /// Over the speeds of the result, 1/kg: Re R_jj, of a rotor that is not axisymmetric the
    /// largest eigenvalue over the directions of the imbalance.
    std::vector<double> criterion;
};

/// Eigenvalues of the joint form at one speed: mean work of elementary imbalances s, s^H Re(R) s.
struct SignaturePoint {
    double speed = 0; ///< rad/s
    /// Ascending, 1/kg: one a plane, two of a rotor that is not axisymmetric (axes x and y).
    std::vector<double> eigenvalues;
    int negative = 0;    ///< how many are
    double relative = 0; ///< the largest over the largest modulus
    /// Imbalances of the largest one, length 1; of a rotor that is not axisymmetric x + i y in its
    /// axes.
    std::vector<std::complex<double>> worst;
};

struct JointBalance {
    BalanceBands bands;
    int rank = 0; ///< independent planes: those of a rigid rotor make no more than two
    std::vector<SignaturePoint> signature;
};

/// The rotor and its supports as a rigid body, about the centre of mass.
struct RigidEquivalent {
    double mass = 0;       ///< kg
    double center = 0;     ///< z of the centre of mass, m
    double diametral = 0;  ///< A, kg m2
    double polar = 0;      ///< C, kg m2
    double anisotropy = 0; ///< diametral inertias A -+ this, kg m2
    double k11 = 0;        ///< N/m
    double k14 = 0;        ///< N
    double k33 = 0;        ///< N m
    std::string
        type; ///< "long", "spherical", "short" or "long about one axis, short about the other"
    std::vector<double> critical_speeds; ///< rad/s
    /// Of translation alone, then of tilt alone where the rotor is long, rad/s.
    std::vector<double> partial_frequencies;
    /// Planes no farther from the centre of mass balance a short rotor at all speeds above its
    /// critical one, m; none of a long rotor.
    std::optional<double> z_max;
    double omega_0 = 0; ///< sqrt(k11/M), M with the masses of the balancers, rad/s
};

/// A place for one auto-balancer, or places for two, over the whole range of speeds.
struct BestPlace {
    std::vector<double> z; ///< m
    double share = 0;      ///< of the speeds, balanced: 0..1
    double margin = 0;     ///< mean of -(largest eigenvalue) times the rotor mass, each cut to +-1
};

/// The criterion along the shaft; values times the mass of the rotor: -1 is a free rigid body.
struct Placement {
    std::vector<double> z;                       ///< m
    std::vector<double> speeds;                  ///< rad/s
    std::vector<std::vector<double>> criterion;  ///< [speed][z], one plane
    std::vector<double> share;                   ///< [z] of the speeds, balanced by one plane
    double pair_speed = 0;                       ///< rad/s
    std::vector<double> pair_z;                  ///< m
    std::vector<std::vector<double>> pair_value; ///< [z1][z2] largest eigenvalue at pair_speed
    BestPlace best;
    BestPlace best_pair;
};

/// How the motion in time ended at one speed.
struct SimulatedSpeed {
    double speed = 0;                     ///< rad/s
    std::string outcome;                  ///< "balanced", "offset", "lagging" or "whirling"
    std::optional<double> residual_ratio; ///< as simulate gives it
    std::optional<double> growth; ///< 1/s, largest of the balanced position with the real balancers
};

/// Where every motion about the balanced position with the real balancers dies out.
struct BalancedPosition {
    std::vector<Interval> bands;      ///< with the arrangement of the case, or the symmetric one
    std::vector<EndErrors> errors;    ///< rad/s
    int arrangements = 0;             ///< looked at; more than one where the balls have a choice
    std::vector<Interval> with_every; ///< stable with every arrangement looked at
    std::vector<Interval> with_some;  ///< stable with at least one
    /// It is the one that all imbalances ask for, elsewhere at every speed; else that of each
    /// balancer against its own.
    bool all_imbalances = false;
    std::vector<Interval> missing{}; ///< rad/s, where they ask for one that there is not
};

/// The same to first order in the mass of the balancers, of their own motions alone: between the
/// criterion and the balanced position.
struct FirstOrder {
    std::vector<Interval> bands;     ///< where all of them die out
    std::vector<KnownErrors> errors; ///< of each band
    /// Over the speeds of the result, times the drag of the case: from here on they die out however
    /// large it is. 0: with any that is told from none. None where they do not.
    std::vector<std::optional<double>> least_drag;
};

/// How far the balancers in the planes get at one speed.
enum class Supply {
    balanced,     ///< each supplies what is needed: no plane moves
    saturated,    ///< some supply all they have, the others leave no motion of their planes
    beyond,       ///< more is needed than there is, and where the balancers end is not known
    unkept,       ///< the criterion does not hold: a balanced position would not be kept
    unstable,     ///< each supplies what is needed, but small motions about that grow
    coarse,       ///< less is needed than a balancer always makes
    out_of_reach, ///< nothing in these planes takes away their motion
    resonance,    ///< without damping: no steady motion
    at_rest,      ///< nothing is needed
    unknown       ///< pendulums, which do not take away the motion of their plane; or not found
};

/// "balanced", "saturated", "beyond capacity", "criterion does not hold", "balanced,
/// unstable", "too coarse", "out of reach", "resonance", "at rest"
/// or "not known".
[[nodiscard]] std::string supply_name(Supply supply);

/// What the balancers of one plane must supply, and can.
/// Rest positions of equal balls that resist rolling, those that hang together with balance.
struct RestWithFriction {
    double residual = 0; ///< no more is left of the motion of the plane, m
    /// Of two balls: angles of a ball from the direction of the imbalance that they are to balance,
    /// between which it rests while the other one mirrors it, rad.
    std::optional<double> from, to;
};

struct PlaneSupply {
    using Moments = std::vector<std::optional<std::complex<double>>>; ///< over the speeds, kg m

    std::optional<double> capacity; ///< kg m; none: no free balancer there
    double least = 0;               ///< what they make at least, kg m
    /// In the rotor, with the phases of the case: direction of the balls' own imbalance.
    Moments needed;
    Moments beside_weights;                     ///< with the weights on
    std::optional<std::complex<double>> weight; ///< the best one in this plane, kg m
    /// Over the speeds; none: no balanced position, or no bound. Empty: the one balancer is not
    /// equal balls that resist rolling, two or more, or there are others.
    std::vector<std::optional<RestWithFriction>> friction;
};

/// Amplitudes over the speeds; none: no limit, or not known.
struct LeftMotion {
    using Values = std::vector<std::optional<double>>;
    Values nothing;   ///< without weights and balancers
    Values weights;   ///< with the best weights in the planes
    Values balancers; ///< with the balancers at their best
    Values both;
};

struct LeftAt {
    std::string of; ///< "probe", "bearing" or "plane"
    std::string name;
    double z = 0;                    ///< m
    LeftMotion amplitude;            ///< reading of a probe, semi-major axis, m
    std::optional<LeftMotion> force; ///< of a bearing, the largest over a turn, N
};

/// What balancers must supply against the imbalances of the rotor wherever these are, and what
/// stays.
struct BalanceSupply {
    bool lag = false;                   ///< the phases of the case count against the spin
    std::vector<PlaneSupply> planes;    ///< as those of the result
    std::vector<Supply> with_balancers; ///< over the speeds
    std::vector<Supply> with_both;
    std::vector<bool> works;           ///< the criterion holds for the planes with balancers
    std::vector<double> weight_speeds; ///< that the weights are best for, rad/s
    std::vector<LeftAt> left;
};

struct BalanceResult {
    ModelSummary model;
    std::vector<double> speeds;          ///< rad/s
    std::vector<double> critical_speeds; ///< forward, in the range; without damping, rad/s
    bool sharp = false; ///< no damping: bands end exactly at critical and pinned critical speeds
    std::vector<BalancePlane> planes;
    JointBalance joint;
    std::optional<RigidEquivalent> rigid;
    std::optional<BalancedPosition> balanced_position; ///< none: no balancers, or no such position
    std::optional<FirstOrder> first_order;             ///< none: not answered, or not asked for
    std::vector<SimulatedSpeed> simulated;
    std::optional<Placement> placement;
    std::vector<PendulumBalance> pendulum;
    std::optional<BalanceSupply> supply; ///< none: nothing to balance, or the motion is not known
    std::optional<SteadyStates> states;  ///< none: not asked for, or no answer
    std::vector<Sentence> findings;      ///< sentences for the reader
};

} // namespace whirl::results
