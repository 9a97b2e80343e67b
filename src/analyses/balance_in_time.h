#pragma once

#include "model/case.h"
#include "results/balance.h"
#include "stability/rotor_at_speeds.h"

#include <optional>
#include <string>
#include <vector>

namespace whirl::analyses {

/// Motions in time with the real balancers, from the start that the case gives, at
/// balance.simulated speeds inside the range; [simulate] says how long. Runs that fail are named
/// in a note. Process 0 only.
/// @param position  by what the growth beside them is judged (judged_position())
[[nodiscard]] std::vector<results::SimulatedSpeed>
simulated_speeds(const model::Case &scene, const std::optional<stability::StabilityModel> &position,
                 std::vector<std::string> &notes);

} // namespace whirl::analyses
