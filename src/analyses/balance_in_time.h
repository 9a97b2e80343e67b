#pragma once

#include "model/case.h"
#include "results/balance.h"

#include <string>
#include <vector>

namespace whirl::analyses {

/// Motions in time with the real balancers, from the start that the case gives, at
/// balance.simulated speeds inside the range; [simulate] says how long. Runs that fail are named
/// in a note. Process 0 only.
[[nodiscard]] std::vector<results::SimulatedSpeed>
simulated_speeds(const model::Case &scene, std::vector<std::string> &notes);

} // namespace whirl::analyses
