#pragma once

#include "results/stability.h"
#include "stability/rotor_at_speeds.h"

namespace whirl::analyses {

/// Notes on what drives the motions that grow, where it drives fast ones: an axial torque that has
/// no potential (how much is left where it has one), a bearing with negative damping.
void note_drives(const stability::StabilityModel &model, results::StabilityResult &result);

} // namespace whirl::analyses
