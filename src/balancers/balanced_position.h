#pragma once

#include "model/attachments.h"

#include <complex>
#include <optional>
#include <string>
#include <vector>

namespace whirl::balancers {

// Where the balls of a balancer stand when they balance its imbalance: angles from the imbalance
// (angles in the rotor less imbalance_phase; class Arrangement holds those in the rotor) with sum
// exp(i a_j) = -n/E (docs/theory.md, "Composite rotor"). Balls only: no position of balls stands
// for the pendulums of a pendulum4.

/// Capacity E = n m R/(m0 R0), infinite without an imbalance. For a pendulum4 the largest imbalance
/// that one tied pair can take, 2 m arm, over the imbalance.
[[nodiscard]] double capacity(const model::Balancer &balancer);

/// The position that the case gives, else the symmetric one; without an imbalance a regular
/// polygon (two balls: opposite each other). One angle a ball, rad.
///
/// @param label  the balancer's path in the case, for messages: "balancer[0]"
/// @throws model::BadInput where there is none: E < 1, one ball with E != 1, a pendulum4.
[[nodiscard]] std::vector<double> ball_angles_at_balance(const model::Balancer &balancer,
                                                         const std::string &label);

/// Ball angles from the imbalance as angles in the rotor, with by = imbalance_phase.
[[nodiscard]] std::vector<double> turned(std::vector<double> angles, double by);

/// Second harmonic D = (1/n) sum exp(2 i a_j) of ball angles.
[[nodiscard]] std::complex<double> second_harmonic_of(const std::vector<double> &angles);

/// Moments of inertia A_m = n m R^2 and A_m0 = m0 R0^2 (0 without imbalance_radius), kg m2.
/// For a pendulum4 R is the pendulums' radius at rest, pivot + arm. Zero with tilt_inertia = false.
struct AddedInertias {
    double balls = 0;
    double imbalance = 0;
};
[[nodiscard]] AddedInertias added_inertias(const model::Balancer &balancer);

/// Least and largest value over all balanced positions, with positions that attain them.
struct PositionInterval {
    double least = 0;
    double largest = 0;
    std::vector<double> least_position;
    std::vector<double> largest_position;
};

/// Most balls for which the intervals over the family are searched; the time grows as n^3.
inline constexpr int largest_searched_count = 40;

/// Interval of |D| over all balanced positions; none without a balanced position or beyond
/// largest_searched_count balls.
[[nodiscard]] std::optional<PositionInterval>
second_harmonic_interval(const model::Balancer &balancer);

/// The same of the anisotropy |A_m0 + A_m D|/2 that the balancer adds, kg m2.
[[nodiscard]] std::optional<PositionInterval> anisotropy_interval(const model::Balancer &balancer);

/// At most `count` balanced positions with different D, the same on every call: first
/// ball_angles_at_balance, then those of least and largest anisotropy, then a low-discrepancy
/// sample of the family. Two balls or fewer, and E = 1: the one position there is.
///
/// @throws model::BadInput as ball_angles_at_balance
[[nodiscard]] std::vector<std::vector<double>>
sampled_positions(const model::Balancer &balancer, int count,
                  const std::string &label = "balancer");

} // namespace whirl::balancers
