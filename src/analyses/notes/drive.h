#pragma once

#include "model/case.h"
#include "results/stability.h"

namespace whirl::analyses {

/// Notes on what drives the motions that grow, where it drives fast ones: an axial torque that has
/// no potential (how much is left where it has one), a bearing with negative damping.
void note_drives(const model::Case &scene, results::StabilityResult &result);

} // namespace whirl::analyses
