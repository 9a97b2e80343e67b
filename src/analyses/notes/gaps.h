#pragma once

#include "results/model_summary.h"
#include "tracking/tracking.h"

#include <string>
#include <vector>

namespace whirl::analyses {

/// Stretches of speed in which something was not found, each by itself while they are few.
void note_gaps(results::ModelSummary &model, const std::vector<tracking::Gap> &gaps,
               const std::string &what);

} // namespace whirl::analyses
