#pragma once

#include "assembly/rotating_system.h"
#include "assembly/system.h"
#include "linalg/matrix.h"
#include "modes/whirl_mode.h"

#include <Eigen/Core>

#include <utility>
#include <vector>

namespace whirl::synchronous {

/// Modes whose frequency is that of the spin.
struct SynchronousModes {
    std::vector<modes::WhirlMode> modes; ///< ascending by Im of the eigenvalue, |spin speed|
    int spin = 1;                        ///< sign of the spin speed
    /// Conservative rotors: which eigenvalue of K(W) - W^2 M, in ascending order from 1, passes
    /// zero at the mode; empty for others. With a subspace of the unknowns it is not smaller
    /// (Courant and Fischer), so that models of one rotor are compared root by root: the first
    /// passage of eigenvalue k with the first passage of k.
    std::vector<int> branches;
    /// Up to this |spin speed| none is missing, rad/s; infinity: the model has no more.
    double complete_to = 0;
    /// |Spin speeds| between which some may be missing, rad/s.
    std::vector<std::pair<double, double>> doubtful;
};

/// The rotor in rotating axes, the balls of its balancers held at their balanced positions.
[[nodiscard]] assembly::RotatingSystem held_in_rotating_axes(const assembly::Discretization &rotor,
                                                             double bearing_speed);

/// What moves under forces that turn with the rotor, M q'' + (C + speed G) q' + (K + speed Kc) q =
/// f, bearings as at a speed: over planar unknowns w = u exp(i speed t) of a rotor that is the same
/// from every direction, K + i speed C - speed^2 (M - G), in which internal damping drops out;
/// else in pairs (x, y).
[[nodiscard]] assembly::FixedSystem turned_system(const assembly::Discretization &rotor,
                                                  bool planar, double bearing_speed);

/// What stands still in axes that turn with the rotor, or repeats there with the bearings, under
/// forces that stand still there: (K + speed Kc - speed^2 M) q = f over pairs (x, y), real; C and G
/// are zero. Masses of balancers are held where they are.
/// @param harmonics  of the series in twice the spin speed (assembly/hill_system.h), the constant
///                   term before the others; 0: of bearings that are the same from every direction
[[nodiscard]] assembly::FixedSystem steady_in_rotating_axes(const assembly::Discretization &rotor,
                                                            double bearing_speed, int harmonics);

/// Powers of two s by which s d s is about 1 for each d >= 0 of a diagonal (1 where d is 0):
/// deflections and slopes have different units, and pivots must not be chosen by them.
[[nodiscard]] Eigen::VectorXd unit_diagonal(const Eigen::VectorXd &diagonal);

/// Rows of all bearing tables of a rotor, rad/s, ascending, each once; empty where there are none.
[[nodiscard]] std::vector<double> table_speeds(const model::Rotor &rotor);

} // namespace whirl::synchronous
