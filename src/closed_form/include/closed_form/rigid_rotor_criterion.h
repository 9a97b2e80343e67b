#pragma once

#include "closed_form/anisotropic_rotor.h"
#include "closed_form/band.h"

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace whirl::closed_form {

/// Rigid axisymmetric rotor on two isotropic elastic supports and the empirical criterion for the
/// occurrence of auto-balancing. Axial positions z are measured from the centre of mass; the left
/// support is at z = -l1, the right one at z = l2. Source: G. Filimonikhin et al., Eastern-European
/// Journal of Enterprise Technologies, empirical criterion for a rotor on two isotropic elastic
/// supports.
struct TwoSupportRotor {
    double mass = 0.0;              ///< kg, M
    double diametral_inertia = 0.0; ///< kg m2, A, about the centre of mass
    double polar_inertia = 0.0;     ///< kg m2, C
    double k11 = 0.0;               ///< N/m, force per deflection
    double k14 = 0.0;               ///< N, force per slope (moment per deflection)
    double k33 = 0.0;               ///< N m, moment per slope
};

/// Rotor on supports of stiffness k1 (N/m) at z = -l1 and k2 at z = l2:
/// k11 = k1 + k2, k14 = k2 l2 - k1 l1, k33 = k1 l1^2 + k2 l2^2.
[[nodiscard]] TwoSupportRotor two_support_rotor(double mass, double diametral_inertia,
                                                double polar_inertia, double k1, double k2,
                                                double l1, double l2);

/// Frequency determinant (k11 - M w^2)(k33 - (A - C) w^2) - k14^2.
[[nodiscard]] double frequency_determinant(const TwoSupportRotor &rotor, double spin_speed);

/// Resonances (forward critical speeds), ascending, rad/s: two for a long rotor, one otherwise.
[[nodiscard]] std::vector<double> resonances(const TwoSupportRotor &rotor);

/// Additional speed of the plane at z (rad/s): critical speed of the rotor pinned there,
/// sqrt[(k33 + k11 z^2 - 2 k14 z)/(A + M z^2 - C)]; none where A + M z^2 <= C.
[[nodiscard]] std::optional<double> additional_speed(const TwoSupportRotor &rotor, double z);

/// Matrix of the criterion on (I, S), moments sum z_j s_j and sum s_j of the elementary imbalances,
/// per axis: auto-balancing where J^T K J / Delta is negative for every J that the planes can make.
/// Returned already divided by Delta: K / Delta, K = [k11 - M w^2, -k14; -k14, k33 - (A - C) w^2].
[[nodiscard]] Eigen::Matrix2d criterion_matrix(const TwoSupportRotor &rotor, double spin_speed);

/// Largest distance of the correction plane from the centre of mass at which a short rotor is
/// balanced at every speed above resonance, sqrt((C - A)/M), m; none for long and spherical rotors.
[[nodiscard]] std::optional<double> largest_plane_distance(const TwoSupportRotor &rotor);

/// Speeds of auto-balancing in one plane at z.
/// Long: (w1, additional) and (w2, inf); spherical: (w1, additional), (w1, inf) for z = 0;
/// short: (w1, additional) while A + M z^2 > C, (w1, inf) otherwise.
[[nodiscard]] std::vector<Band> static_balancing_bands(const TwoSupportRotor &rotor, double z);

/// Speeds of auto-balancing in two or more different planes: (w2, inf) of a long rotor, none
/// otherwise.
[[nodiscard]] std::vector<Band> dynamic_balancing_bands(const TwoSupportRotor &rotor);

} // namespace whirl::closed_form
