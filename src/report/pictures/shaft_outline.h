#pragma once

#include "model/shaft.h"

namespace whirl::report {

/// Outer radius at z, m; where two segments meet, the larger one.
[[nodiscard]] double shaft_radius(const model::Shaft &shaft, double z);

} // namespace whirl::report
