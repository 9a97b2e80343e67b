#pragma once

#include "model/case.h"

namespace whirl::properties {

/// A whole scene drawn at random: 2-5 discs, every kind of bearing (isotropic, orthotropic,
/// cross-coupled, damped, with tables, pedestals and stiffness against tilt), rotating
/// anisotropies, internal damping, ball balancers, imbalances and correction planes; three speeds.
/// Coarse meshes, so that thousands of them are solved in minutes.
[[nodiscard]] model::Case random_scene(int number);

} // namespace whirl::properties
