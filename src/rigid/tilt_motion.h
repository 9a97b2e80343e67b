#pragma once

#include "model/rotor.h"

#include <optional>

namespace whirl::rigid {

/// Closed form of the permissible inertial anisotropy (kg m2) of this rotor as a rigid body, over
/// the spin speeds from `from` to `to` (rad/s). None where the closed form does not apply.
[[nodiscard]] std::optional<double> rigid_permissible_anisotropy(const model::Rotor &rotor,
                                                                 double from, double to);

} // namespace whirl::rigid
