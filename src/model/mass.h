#pragma once

#include "model/rotor.h"

namespace whirl::model {

/// Mass of the shaft with its layers, kg.
[[nodiscard]] double mass_of(const Shaft &shaft);

/// Polar inertia of the shaft with its layers about its axis, kg m2; none without rotary inertia.
[[nodiscard]] double polar_inertia_of(const Shaft &shaft);

/// Mass of shaft and discs, kg; without balancers.
[[nodiscard]] double mass_of_shaft_and_discs(const Rotor &rotor);

} // namespace whirl::model
