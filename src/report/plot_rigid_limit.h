#pragma once

#include "model/case.h"
#include "report/gnuplot.h"
#include "results/rigid_limit.h"

namespace whirl::report {

/// Relative differences between model and rigid closed forms, logarithmic: over the stiffness of
/// the shaft, with a guide of slope -1 and the stiffness of 1 %, and over the number of elements.
[[nodiscard]] Figure rigid_limit_figure(const model::Case &scene,
                                        const results::RigidLimitResult &result);

} // namespace whirl::report
