#pragma once

#include "model/case.h"
#include "report/gnuplot.h"
#include "results/accuracy.h"

namespace whirl::report {

/// True error over wall time and over unknowns, logarithmic, one line for each element family and
/// order.
[[nodiscard]] Figure accuracy_figure(const model::Case &scene,
                                     const results::AccuracyResult &result);

} // namespace whirl::report
