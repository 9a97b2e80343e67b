#pragma once

#include "model/case.h"
#include "results/weights.h"

namespace whirl::analyses {

/// Correction weights (docs/theory.md, "Correction weights"): those that make the vibration of the
/// case least at its probes and speeds. Vibrations are readings, or those that the imbalances of
/// the case make; influence coefficients come from trial runs, from a table, or from the model.
/// @throws model::BadInput where readings, planes or speeds are missing or do not tell planes
/// apart; model::AnalysisFailure at an undamped resonance, and for rotors that are not the same
/// from every direction, whose vibration does not turn with the weight.
[[nodiscard]] results::WeightsResult correction_weights(const model::Case &scene);

} // namespace whirl::analyses
