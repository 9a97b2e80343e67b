#pragma once

#include "assembly/discretization.h"

namespace whirl::assembly {

/// A frequency of the order of the first one of the rigid rotor on its supports, rad/s;
/// elastic_scale where no support resists a translation.
[[nodiscard]] double support_scale(const Discretization &discretization);

/// A frequency of the order of the first bending one of the free shaft, rad/s; never zero.
[[nodiscard]] double elastic_scale(const Discretization &discretization);

} // namespace whirl::assembly
