#pragma once

#include "results/simulate.h"
#include "simulation/equations.h"

namespace whirl::simulation {

/// Reads from the series of a result how its motion ended: fills balancers (their amplitudes and
/// references must be there), outcome, evidence, residual_ratio, station_ratio, trend and
/// decision_time; stations, at_rest and linear_growth must be there where they are known.
///
/// By the last tenth of the time alone: a ball that drifts by more than half a turn
/// lags; one that swings to and fro by more than 0.05 rad over the last fortieth whirls; else all
/// stands still, balanced where less than a tenth of the unbalanced amplitude is left, at the
/// balancers and at the stations.
///
/// Whether that lasts, by the trend over the last half (trend.h), at constant speed: growing
/// where the amplitude or its swing, or the swing of the balls grows steadily. Undecided where a
/// swing dies out that is still large, or balls still creep or the amplitude still falls towards
/// balance; where balls that all but stand still are not where the whirl would leave them, however
/// slow they are against the time of the motion; and where all looks balanced while the
/// eigenvalues promise growth. The amplitude of a rotor that moves as it would with the balls fixed
/// where they are does not grow by itself: it changes as they move.
void classify(const model::Case &scene, results::SimulateResult &result);

/// The speed changed by less than a thousandth over the last half of the time.
[[nodiscard]] bool ends_at_constant_speed(const results::SimulateResult &result);

} // namespace whirl::simulation
