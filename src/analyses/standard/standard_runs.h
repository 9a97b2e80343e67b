#pragma once

#include "model/case.h"
#include "operation/standard_unbalance.h"
#include "results/response.h"

#include <vector>

namespace whirl::analyses {

/// unbalance_response with the runs of [standard], where the case has that section: the imbalances
/// of each run in place of those of the case, everything else as in the case. A case without an
/// imbalance of its own has those of the first run.
[[nodiscard]] results::ResponseResult response_with_runs(const model::Case &scene);

/// The imbalances of [standard] unbalance = "api617": by the shapes of the critical speeds (damped,
/// `modes`) up to 1.26 times the maximum continuous speed, of the lowest one where none is that
/// low. Backward ones count where the bearings differ between their directions, as imbalance
/// excites them then. None where no shape was found. Collective under mpirun.
[[nodiscard]] std::vector<operation::PlacedUnbalance> standard_unbalance(const model::Case &scene);

/// The case as of one run.
[[nodiscard]] model::Case scene_of_run(model::Case scene, const results::StandardRun &run);

} // namespace whirl::analyses
