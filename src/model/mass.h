#pragma once

#include "model/rotor.h"

namespace whirl::model {

/// Mass of the shaft with its layers, kg.
[[nodiscard]] double mass_of(const Shaft &shaft);

/// Polar inertia of the shaft with its layers about its axis, kg m2; none without rotary inertia.
[[nodiscard]] double polar_inertia_of(const Shaft &shaft);

/// Mass of shaft and discs, kg; without balancers.
[[nodiscard]] double mass_of_shaft_and_discs(const Rotor &rotor);

/// Shaft and discs between two places; discs in these places not among them.
struct MassBetween {
    double mass = 0;   ///< kg
    double moment = 0; ///< integral of z over the mass, kg m
};
[[nodiscard]] MassBetween mass_between(const Rotor &rotor, double from, double to);

} // namespace whirl::model
