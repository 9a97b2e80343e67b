#pragma once

#include "assembly/discretization.h"
#include "balancers/linear_element.h"
#include "linalg/matrix.h"

#include <vector>

namespace whirl::assembly {

/// In axes that turn with the rotor, q real in pairs (x, y), constant coefficients at each speed:
///
///     M q'' + (C + speed Cs) q' + (K + speed Ks + speed^2 Kss) q = 0
///
/// Unknowns: those of the discretization, then pairs for the small motions of the balancers
/// (balancers/linear_element.h). A type of its own: it cannot be taken for a system in the fixed
/// frame.
struct RotatingSystem {
    linalg::Matrix M;
    linalg::Matrix C, Cs;
    linalg::Matrix K, Ks, Kss;

    [[nodiscard]] linalg::Matrix damping(double speed) const;
    [[nodiscard]] linalg::Matrix stiffness(double speed) const;
};

/// What supports that are not the same from every direction add in rotating axes, where they turn
/// backwards twice a revolution: each matrix is cosine * cos(2 speed t) + sine * sin(2 speed t).
struct PeriodicSupports {
    struct Pair {
        linalg::Matrix cosine, sine;
    };
    Pair C, K, Ks; ///< C q' + (K + speed Ks) q
};

/// Bearings as at `bearing_speed` (rad/s); only the part of them that is the same from every
/// direction, see periodic_supports for the rest.
/// @param balancers  elements at their balanced positions, any number; with `frozen` their masses
///                   are held in place: no unknowns of their own
[[nodiscard]] RotatingSystem
assemble_rotating(const Discretization &discretization, double bearing_speed,
                  const std::vector<balancers::BalancerElement> &balancers, bool frozen = false);

/// @param unknowns  real unknowns of the system it goes with
[[nodiscard]] PeriodicSupports periodic_supports(const Discretization &discretization,
                                                 double bearing_speed, int unknowns);

} // namespace whirl::assembly
