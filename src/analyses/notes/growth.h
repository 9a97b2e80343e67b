#pragma once

#include "analyses/names/mode_naming.h"
#include "results/model_summary.h"

namespace whirl::analyses {

/// A note where a free motion grows at speeds of the case: the steady motion is not the one a rotor
/// would be in there.
void note_growing_motions(const ModesBeside &modes, results::ModelSummary &model);

} // namespace whirl::analyses
