#pragma once

#include "model/case.h"
#include "results/model_summary.h"

namespace whirl::analyses {

/// A note where a free motion grows at speeds of the case: the steady motion is not the one a rotor
/// would be in there.
/// @param model  of the response: its order is taken
void note_growing_motions(const model::Case &scene, results::ModelSummary &model);

} // namespace whirl::analyses
