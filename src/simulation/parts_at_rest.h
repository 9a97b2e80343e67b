#pragma once

#include "model/case.h"
#include "results/simulate.h"

namespace whirl::simulation {

/// The steady motion with the parts of the balancers fixed where they are at the end
/// (results::PartsAtRest, StationMotion::with_balls), whether they stay there, and what is left in
/// the rotor. Nothing where there is no such motion or the speed still changes. References of the
/// balancers must be there.
void add_parts_at_rest(const model::Case &scene, int order, results::SimulateResult &result);

} // namespace whirl::simulation
