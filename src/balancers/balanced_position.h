#pragma once

#include "closed_form/arrangement_interval.h"
#include "model/balancer.h"

#include <complex>
#include <optional>
#include <string>
#include <vector>

namespace whirl::balancers {

// Where the masses of a balancer (balls, centres of rings) stand when they balance its imbalance:
// angles from the imbalance (angles in the rotor less imbalance_phase; class Arrangement holds
// those in the rotor) with sum m_j R_j exp(i a_j) = -m0 R0 (docs/theory.md, "Composite rotor").
// Pendulums have no such angles.

/// Capacity E: the largest imbalance that the parts can balance over the imbalance, infinite
/// without one. Balls: n m R/(m0 R0); pendulum4: 2 m arm, by one tied pair; rings: n m e.
[[nodiscard]] double capacity(const model::Balancer &balancer);

/// The position that the case gives, else the usual one: symmetric, without an imbalance a regular
/// polygon (two masses: opposite each other). One angle a mass, rad.
///
/// @param label  the balancer's path in the case, for messages: "balancer[0]"
/// @throws model::BadInput where there is none: E < 1, one ball with E != 1, a pendulum4.
[[nodiscard]] std::vector<double> angles_at_balance(const model::Balancer &balancer,
                                                    const std::string &label);

/// Angles from the imbalance as angles in the rotor, with by = imbalance_phase.
[[nodiscard]] std::vector<double> turned(std::vector<double> angles, double by);

/// Second harmonic D = sum m_j R_j^2 exp(2 i a_j) / sum m_j R_j^2, of equal masses their mean; 0
/// without masses on circles.
[[nodiscard]] std::complex<double> second_harmonic_of(const model::Balancer &balancer,
                                                      const std::vector<double> &angles);

/// The imbalance as a point mass m0 at R0: kg, and m0 R0^2, kg m2; 0 without imbalance_radius.
[[nodiscard]] double imbalance_mass(const model::Balancer &balancer);
[[nodiscard]] double imbalance_inertia(const model::Balancer &balancer);

/// Moments of inertia, kg m2. Zero with tilt_inertia = false.
struct AddedInertias {
    double parts = 0;     ///< A_m = sum m R^2; pendulum4: R their radius at rest, pivot + arm
    double imbalance = 0; ///< A_m0: imbalance_inertia()
    double own = 0;       ///< of parts about axes of their own

    [[nodiscard]] double polar() const { return parts + own + imbalance; }
};
[[nodiscard]] AddedInertias added_inertias(const model::Balancer &balancer);

/// Mass of the parts and, where it is a point mass, of the imbalance, kg.
[[nodiscard]] double mass_of(const model::Balancer &balancer);

/// Least and largest value over all balanced positions, with positions that attain them.
using PositionInterval = closed_form::ArrangementInterval;

/// Most masses for which the intervals over the family are searched; the time grows as n^3.
inline constexpr int largest_searched_count = 40;

/// Interval of |D| over all balanced positions; none without a balanced position or beyond
/// largest_searched_count masses. Global for equal masses; of masses that differ the best of a
/// search from many starts (balance_family.h).
[[nodiscard]] std::optional<PositionInterval>
second_harmonic_interval(const model::Balancer &balancer);

/// The same of the anisotropy |A_m0 + A_m D|/2 that the balancer adds, kg m2.
[[nodiscard]] std::optional<PositionInterval> anisotropy_interval(const model::Balancer &balancer);

/// At most `count` balanced positions with different D, the same on every call: first
/// angles_at_balance, then those of least and largest anisotropy, then a low-discrepancy sample of
/// the family. Where there is one position only (two masses or fewer, E = 1): that one.
///
/// @throws model::BadInput as angles_at_balance
[[nodiscard]] std::vector<std::vector<double>>
sampled_positions(const model::Balancer &balancer, int count,
                  const std::string &label = "balancer");

} // namespace whirl::balancers
