#pragma once

#include "balancers/kind.h"

#include <complex>
#include <vector>

namespace whirl::balancers {

// Masses of any moments m_j R_j on circles that balance an imbalance m0 R0 at angle 0:
// sum m_j R_j exp(i a_j) = -m0 R0. The polygon of these vectors closes where no side is longer than
// all others together; with three masses or more it is a mechanism, and the positions are a family.

/// Of equal masses the symmetric position at capacity E >= 1 (docs/theory.md, "Composite rotor"):
/// one mass opposite the imbalance; without an imbalance a regular polygon with a side symmetric
/// about angle 0.
/// @param capacity  may be infinite
[[nodiscard]] std::vector<double> symmetric_position(int masses, double capacity);

/// What masses at these angles leave of the balance: m0 R0 + sum m_j R_j exp(i a_j), kg m.
[[nodiscard]] std::complex<double> defect_of(const std::vector<CircledMass> &masses,
                                             double imbalance, const std::vector<double> &angles);

/// There is such a position.
[[nodiscard]] bool balance_exists(const std::vector<CircledMass> &masses, double imbalance);

/// A point of the family, index >= 0: every mass takes an angle that leaves a sum which the others
/// can close, the last two close it. Index 0: in the middle of what is possible; the others fill
/// the family evenly.
[[nodiscard]] std::vector<double> position_of_family(const std::vector<CircledMass> &masses,
                                                     double imbalance, int index);

/// Minimum-norm Newton steps back to balance from a position that misses it slightly.
void restore_balance(const std::vector<CircledMass> &masses, double imbalance,
                     std::vector<double> &angles);

/// Along the family from one of its positions to where |sum factor_j exp(2 i a_j)| is a minimum
/// (sign 1) or a maximum (-1).
[[nodiscard]] std::vector<double> extreme_beside(const std::vector<CircledMass> &masses,
                                                 double imbalance,
                                                 const std::vector<double> &factors, double sign,
                                                 std::vector<double> angles);

/// The position at which |constant + sum factor_j exp(2 i a_j)| is least (sign 1) or largest (-1)
/// among those that the method of steepest descent along the family finds from `starts` points of
/// it; for masses that differ, where no closed form is known.
[[nodiscard]] std::vector<double> extreme_position(const std::vector<CircledMass> &masses,
                                                   double imbalance, double constant,
                                                   const std::vector<double> &factors, double sign);

} // namespace whirl::balancers
