#pragma once

#include "cli/arguments.h"
#include "model/case.h"
#include "results/simulate.h"

namespace whirl::cli {

/// The motion, from the restart file that the case names if any. On SIGINT writes a restart file
/// into the folder for results.
/// @throws model::AnalysisFailure then, with what to do to go on.
[[nodiscard]] results::SimulateResult simulate_or_leave_restart(const Arguments &arguments,
                                                                const model::Case &scene);

} // namespace whirl::cli
