#pragma once

#include "model/case.h"
#include "results/simulate.h"
#include "simulation/equations.h"
#include "simulation/run.h"

namespace whirl::analyses {

/// The limit cycle next to the end of a motion in which balls lag or swing, and its branch over the
/// speeds of [simulate.cycle]; a note says why there is none.
void add_limit_cycle(const model::Case &scene, const simulation::MotionScene &motion,
                     const simulation::Run &run, results::SimulateResult &result);

} // namespace whirl::analyses
