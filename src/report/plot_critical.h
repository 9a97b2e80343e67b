#pragma once

#include "model/case.h"
#include "report/gnuplot.h"
#include "results/critical.h"

namespace whirl::report {

/// The critical speeds as marks on a speed axis, forward and backward in rows of their own.
[[nodiscard]] Figure critical_figure(const model::Case &scene,
                                     const results::CriticalResult &result);

} // namespace whirl::report
