#pragma once

#include <complex>
#include <optional>
#include <vector>

namespace whirl::balancers {

// Equal masses on one circle that balance, as all kinds with such masses need them. Angles from the
// imbalance, rad.

/// The symmetric position at capacity E >= 1 (docs/theory.md, "Composite rotor"): one mass opposite
/// the imbalance; without an imbalance a regular polygon with a side symmetric about angle 0.
/// @param capacity  may be infinite
[[nodiscard]] std::vector<double> symmetric_position(int masses, double capacity);

/// (1/n) sum exp(2 i a_j) of the masses from `first` to `last` - 1.
[[nodiscard]] std::complex<double> second_harmonic(const std::vector<double> &angles,
                                                   std::size_t first, std::size_t last);

} // namespace whirl::balancers
