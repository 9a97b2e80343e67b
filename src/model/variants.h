#pragma once

#include "model/rotor.h"

namespace whirl::model {

/// The rotor with nothing that takes energy out or, turning, feeds it in: no dampers in bearings
/// and pedestals, no internal damping. Coupling stiffness stays.
[[nodiscard]] Rotor without_damping(Rotor rotor);

} // namespace whirl::model
