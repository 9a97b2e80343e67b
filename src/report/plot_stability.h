#pragma once

#include "report/gnuplot.h"
#include "results/stability.h"

namespace whirl::report {

/// Growth over speed with the unstable bands shaded, critical and additional speeds marked, and
/// the intervals over the arrangements of the balls as bars; with a map its picture below.
[[nodiscard]] Figure stability_figure(const model::Case &scene,
                                      const results::StabilityResult &result);

} // namespace whirl::report
