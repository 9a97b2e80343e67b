#pragma once

#include "results/model_summary.h"

namespace whirl::analyses {

/// Whirl speeds of a rotor whose equations stay periodic in time, next to rest.
/// @param speed  as PeriodicDiagram::unconfirmed, rad/s
void note_unconfirmed(results::ModelSummary &model, double speed);

} // namespace whirl::analyses
