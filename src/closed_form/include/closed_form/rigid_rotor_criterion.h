#pragma once

#include "closed_form/anisotropic_rotor.h"

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
    /// a: the diametral inertias about the principal axes are A - a and A + a, kg m2. On isotropic
    /// supports what stands still in rotating axes parts into the planes through these axes, each
    /// that of a rotor with A - a or A + a (the moment that turns the slope by its plane is
    /// (C - A + a) w^2); an imbalance has components in both, and is balanced whatever its
    /// direction where each of the two rotors is.
    double anisotropy = 0.0;
};

/// Resonances (forward critical speeds), ascending, rad/s: of each principal plane two for a long
/// rotor, one otherwise; without anisotropy, each once.
[[nodiscard]] std::vector<double> resonances(const TwoSupportRotor &rotor);

/// Partial frequencies, rad/s: of translation alone, sqrt(k11/M), then of tilt alone,
/// sqrt[k33/(A - C)], for each principal plane in which A > C. Without coupling (k14 = 0) they are
/// the resonances; else the resonances lie outside of them, w1 < wp1 < wp2 < w2.
[[nodiscard]] std::vector<double> partial_frequencies(const TwoSupportRotor &rotor);

/// z_max = sqrt[(C - A)/M], m: planes no farther from the centre of mass balance a short rotor at
/// all speeds above its resonance (a spherical one: at 0). None of a long rotor. With anisotropy of
/// the larger diametral inertia.
[[nodiscard]] std::optional<double> farthest_plane(const TwoSupportRotor &rotor);

/// Additional speed of the plane at z (rad/s), without anisotropy: critical speed of the rotor
/// pinned there,
/// sqrt[(k33 + k11 z^2 - 2 k14 z)/(A + M z^2 - C)]; none where A + M z^2 <= C.
[[nodiscard]] std::optional<double> additional_speed(const TwoSupportRotor &rotor, double z);

/// Speeds of auto-balancing in one plane at z.
/// Long: (w1, additional) and (w2, inf); spherical: (w1, additional), (w1, inf) for z = 0;
/// short: (w1, additional) while A + M z^2 > C, (w1, inf) otherwise.
/// With anisotropy, what the bands of both principal planes have in common.
[[nodiscard]] std::vector<Band> static_balancing_bands(const TwoSupportRotor &rotor, double z);

/// Speeds of auto-balancing in two or more different planes: (w2, inf) of a long rotor, none
/// otherwise. With anisotropy, what the bands of both principal planes have in common.
[[nodiscard]] std::vector<Band> dynamic_balancing_bands(const TwoSupportRotor &rotor);

} // namespace whirl::closed_form
