#pragma once

#include "model/rotor.h"

namespace whirl::modes {

/// The stiffness of the rotor at rest on its bearings is positive definite, with elements of this
/// order: an undamped rotor then has a positive energy that is conserved. With bearing tables, with
/// the bearings of every row.
[[nodiscard]] bool stiffness_positive(const model::Rotor &rotor, int order);

/// Something can push the rotor away from its place: a bearing with a negative stiffness in some
/// direction, or an axial force that presses. Without it the stiffness has no negative direction.
[[nodiscard]] bool may_push_away(const model::Rotor &rotor);

} // namespace whirl::modes
