#pragma once

#include "simulation/motion.h"

#include <vector>

namespace whirl::simulation {

/// Who may touch whom, and who resists rolling: neighbours in each race by their angles at the
/// start, which they remain.
/// @param angles  of all coordinates at the start, rad
/// @param rate    1/s, see DryState
/// @throws model::BadInput where parts that cannot pass each other overlap at the start.
[[nodiscard]] DryState dry_state(const MovingParts &parts, const std::vector<double> &angles,
                                 double rate);

} // namespace whirl::simulation
