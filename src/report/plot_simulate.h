#pragma once

#include "model/case.h"
#include "report/gnuplot.h"
#include "results/simulate.h"

namespace whirl::report {

/// Motion over time: amplitudes at the balancers, below them the angles of balls or pendulums in
/// the rotor (for balls that lag: their speed over that of the rotor), and the speed where it
/// changes.
[[nodiscard]] Figure simulate_figure(const model::Case &scene,
                                     const results::SimulateResult &result);

} // namespace whirl::report
