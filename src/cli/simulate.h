#pragma once

#include "analyses/simulate_result.h"
#include "cli/arguments.h"
#include "model/case.h"

namespace whirl::cli {

/// The motion, from the restart file that the case names if any. On SIGINT writes a restart file
/// into the folder for results.
/// @throws model::AnalysisFailure then, with what to do to go on.
[[nodiscard]] analyses::SimulateResult simulate_or_leave_restart(const Arguments &arguments,
                                                                 const model::Case &scene);

} // namespace whirl::cli
