#pragma once

#include "closed_form/rigid_rotor_criterion.h"

#include <Eigen/Core>
#include <optional>

namespace whirl::closed_form {

/// Rotor on supports of stiffness k1 (N/m) at z = -l1 and k2 at z = l2:
/// k11 = k1 + k2, k14 = k2 l2 - k1 l1, k33 = k1 l1^2 + k2 l2^2.
[[nodiscard]] TwoSupportRotor two_support_rotor(double mass, double diametral_inertia,
                                                double polar_inertia, double k1, double k2,
                                                double l1, double l2);

/// Frequency determinant (k11 - M w^2)(k33 - (A - C) w^2) - k14^2.
[[nodiscard]] double frequency_determinant(const TwoSupportRotor &rotor, double spin_speed);

/// Matrix of the criterion on (I, S), moments sum z_j s_j and sum s_j of the elementary imbalances,
/// per axis: auto-balancing where J^T K J / Delta is negative for every J that the planes can make.
/// Returned already divided by Delta: K / Delta, K = [k11 - M w^2, -k14; -k14, k33 - (A - C) w^2].
[[nodiscard]] Eigen::Matrix2d criterion_matrix(const TwoSupportRotor &rotor, double spin_speed);

/// Largest distance of the correction plane from the centre of mass at which a short rotor is
/// balanced at every speed above resonance, sqrt((C - A)/M), m; none for long and spherical rotors.
[[nodiscard]] std::optional<double> largest_plane_distance(const TwoSupportRotor &rotor);

} // namespace whirl::closed_form
