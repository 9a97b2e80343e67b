#pragma once

#include "report/common/gnuplot.h"
#include "report/compare/comparison.h"

namespace whirl::report {

/// The results over one another (whirl frequencies, response curves, growth or critical speeds over
/// spin speed, where the command has them), and below each relative difference beside its error
/// bar.
[[nodiscard]] Figure comparison_figure(const Comparison &comparison);

} // namespace whirl::report
