#pragma once

#include <complex>
#include <optional>
#include <span>
#include <vector>

namespace whirl::closed_form {

/// Positions of n equal balls, angles in the rotor from the imbalance, at which they balance it:
/// sum cos a_j = -n/E, sum sin a_j = 0. Source: A. N. Gorbenko, Mass-inertia characteristics and
/// dimensionless equations of motion of a rotor with an auto-balancer, section 2.4.

/// Symmetric balanced position, none for E < 1 or fewer than two balls. Even n: n/2 balls at each
/// of
/// +-acos(-1/E) (two balls: the only position there is). Odd n: one ball opposite the imbalance, at
/// pi, and (n-1)/2 balls at each of +-acos[-(n/E - 1)/(n - 1)]. Balls of one group stand for balls
/// side by side.
[[nodiscard]] std::optional<std::vector<double>> symmetric_position(int balls, double capacity);

/// Second harmonic of the arrangement D = D_c + i D_s = (1/n) sum exp(2 i a_j). The paper keeps D_A
/// = |D|.
[[nodiscard]] std::complex<double> second_harmonic(std::span<const double> angles);

} // namespace whirl::closed_form
