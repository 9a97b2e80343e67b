#pragma once

#include "model/rotor.h"

namespace whirl::model {

// The same rotor with one thing left out or changed.

/// The rotor with nothing that takes energy out or, turning, feeds it in: no dampers in bearings
/// and pedestals, no internal damping. Coupling stiffness stays.
[[nodiscard]] Rotor without_damping(Rotor rotor);

/// Supports without damping and with the symmetric part of their stiffness; tables and everything
/// else as they are.
[[nodiscard]] Rotor with_conservative_supports(Rotor rotor);

/// Bearings isotropic, with the mean of the x and y coefficients; nothing changes for isotropic
/// ones.
[[nodiscard]] Rotor with_mean_bearings(Rotor rotor);

/// E and G of the shaft multiplied.
[[nodiscard]] Rotor stiffened(Rotor rotor, double factor);

/// With shaft elements of this order where the order was to be found.
[[nodiscard]] Rotor with_order(Rotor rotor, int order);

/// Without elastic unknowns.
[[nodiscard]] Rotor without_elasticity(Rotor rotor);

/// The imbalances that balancers are there for among those of the rotor.
[[nodiscard]] Rotor with_balancer_imbalances(Rotor rotor);

} // namespace whirl::model
