#pragma once

#include "model/operation.h"
#include "model/rotor.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace whirl::model {

// The same rotor with one thing left out or changed.

/// The rotor with nothing that takes energy out or, turning, feeds it in: no dampers in bearings
/// and pedestals, none of the shaft. Coupling stiffness stays.
[[nodiscard]] Rotor without_damping(Rotor rotor);

/// Bearings isotropic, with the mean of the x and y coefficients; nothing changes for isotropic
/// ones.
[[nodiscard]] Rotor with_mean_bearings(Rotor rotor);

/// Without damping and axial torque, and with supports that are isotropic: with_mean_bearings.
[[nodiscard]] Rotor isotropic_without_damping(Rotor rotor);

/// One support, or all of them (no seals), of isotropic stiffness k (N/m) over speeds (rad/s;
/// empty: one k at every speed); mass and tilt stiffness as in their first row, no damping.
/// @param support  its place among supports(); none: all
[[nodiscard]] Rotor with_support_stiffness(Rotor rotor, std::optional<std::size_t> support,
                                           const std::vector<double> &k,
                                           const std::vector<double> &speeds = {});

/// E and G of the shaft multiplied.
[[nodiscard]] Rotor stiffened(Rotor rotor, double factor);

/// With shaft elements of this order where the order was to be found.
[[nodiscard]] Rotor with_order(Rotor rotor, int order);

/// Without elastic unknowns.
[[nodiscard]] Rotor without_elasticity(Rotor rotor);

/// Bearings and seals with the tables of their least or largest clearance, where they have one.
[[nodiscard]] Rotor with_fit(Rotor rotor, BearingFit fit);

/// The imbalances that balancers are there for among those of the rotor.
[[nodiscard]] Rotor with_balancer_imbalances(Rotor rotor);

} // namespace whirl::model
