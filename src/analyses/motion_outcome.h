#pragma once

#include "analyses/motion_scene.h"
#include "analyses/simulate_result.h"

namespace whirl::analyses {

/// Reads from the series of a result how its motion ended: fills balancers (their amplitudes and
/// references must be there), outcome, evidence and residual_ratio.
///
/// Over the last tenth of the time: a ball that drifts by more than half a turn lags; one that
/// swings by more than 0.05 rad over the last fortieth whirls; else all stands still, balanced
/// where less than a tenth of the unbalanced amplitude is left.
void classify(const model::Case &scene, SimulateResult &result);

} // namespace whirl::analyses
