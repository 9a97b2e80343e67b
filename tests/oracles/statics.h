#pragma once

#include "oracles/continuum.h"

namespace whirl::oracles {

/// Deflection (x, y) at z (m) of the rotor at rest under a force (N) at z_force.
struct StaticDeflection {
    Real x = 0;
    Real y = 0;
};

/// Exact: straight Timoshenko beams between the places where something stands, supports with their
/// pedestals; mass, damping and gyroscopic moments do not matter.
[[nodiscard]] StaticDeflection static_deflection(const SteppedRotor &rotor, double z_force,
                                                 Real force_x, Real force_y, double z);

} // namespace whirl::oracles
