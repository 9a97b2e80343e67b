#pragma once

#include "analyses/balance_result.h"
#include "model/case.h"

#include <string>
#include <vector>

namespace whirl::analyses {

/// Motions in time with the real balancers, from the start that the case gives, at
/// balance.simulated speeds inside the range; [simulate] says how long. Runs that fail are named
/// in a note. Process 0 only.
[[nodiscard]] std::vector<SimulatedSpeed> simulated_speeds(const model::Case &scene,
                                                           std::vector<std::string> &notes);

} // namespace whirl::analyses
