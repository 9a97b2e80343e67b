#pragma once

#include "results/interval.h"
#include "results/model_summary.h"
#include "results/pendulum.h"

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
};

/// Where one plane alone, or all of them together, can balance the rotor.
struct BalanceBands {
    std::vector<Interval> bands;                      ///< of the rotor of the case
    std::optional<std::vector<Interval>> rigid_bands; ///< closed form; none where it has no form
    std::vector<double> pinned; ///< forward critical speeds of the rotor pinned there, rad/s
    std::vector<BandEnd> ends;
    /// Of each band: errors of its ends, rad/s; 0 at an end of the range, none where not known.
    std::vector<std::pair<std::optional<double>, std::optional<double>>> errors;
};

struct BalancePlane {
    std::string name;
    double z = 0; ///< m
    BalanceBands bands;
    std::vector<double> criterion; ///< Re R_jj over the speeds of the result, 1/kg
};

/// Eigenvalues of the joint form at one speed: mean work of elementary imbalances s, s^H Re(R) s.
struct SignaturePoint {
    double speed = 0;                        ///< rad/s
    std::vector<double> eigenvalues;         ///< ascending, 1/kg
    int negative = 0;                        ///< how many are
    double relative = 0;                     ///< the largest over the largest modulus
    std::vector<std::complex<double>> worst; ///< imbalances of the largest one, length 1
};

struct JointBalance {
    BalanceBands bands;
    int rank = 0; ///< of the form: planes of a rigid rotor make no more than two
    std::vector<SignaturePoint> signature;
};

/// The rotor and its supports as a rigid body, about the centre of mass.
struct RigidEquivalent {
    double mass = 0;                     ///< kg
    double center = 0;                   ///< z of the centre of mass, m
    double diametral = 0;                ///< A, kg m2
    double polar = 0;                    ///< C, kg m2
    double k11 = 0;                      ///< N/m
    double k14 = 0;                      ///< N
    double k33 = 0;                      ///< N m
    std::string type;                    ///< "long", "spherical" or "short"
    std::vector<double> critical_speeds; ///< rad/s
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
    std::vector<SimulatedSpeed> simulated;
    std::optional<Placement> placement;
    std::vector<PendulumBalance> pendulum;
    std::vector<Sentence> findings; ///< sentences for the reader
};

} // namespace whirl::results
