#pragma once

#include "balancers/kind.h"

#include <complex>
#include <vector>

namespace whirl::balancers {

/// An auto-balancer at its balanced position as a linear element of a rotating node. With w, phi
/// the deflection and slope of the node in rotating axes, a_A = w'' + 2 i Omega w' - Omega^2 w:
///
///     node:   as a rigid body: mass, diametral and polar inertia,
///             anisotropy * conj(phi'' + Omega^2 phi); and the pull of its small motions
///     itself: small motions of the parts (kind.h)
struct BalancerElement {
    double z = 0;                    ///< m
    double mass = 0;                 ///< of all parts and m0, kg
    double polar_inertia = 0;        ///< twice the diametral one, kg m2
    std::complex<double> anisotropy; ///< (A_m0 + A_m D)/2, kg m2
    SmallMotions parts;

    /// Complex unknowns of its own.
    [[nodiscard]] int unknowns() const { return static_cast<int>(parts.pull.size()); }
};

/// Complex unknowns of all elements.
[[nodiscard]] inline int unknowns_of(const std::vector<BalancerElement> &elements) {
    int sum = 0;
    for (const BalancerElement &element : elements)
        sum += element.unknowns();
    return sum;
}

} // namespace whirl::balancers
