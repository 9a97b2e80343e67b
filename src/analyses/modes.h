#pragma once

#include "model/case.h"
#include "results/modes.h"

namespace whirl::analyses {

/// Shapes of the whirl modes with the lowest frequencies (campbell.modes of them) at speeds.from,
/// at stations close enough to draw; over a range of speeds also at each critical speed the mode
/// that is critical there, with balancers the bent rotor with their parts held. Each is scaled by a
/// complex number so that the largest component of any deflection is 1. Labels count the modes of
/// each sense, ascending: 1B, 1F, 2B...
/// @throws model::BadInput without [speeds]; model::AnalysisFailure where the modes are not found.
[[nodiscard]] results::ModesResult mode_shapes(const model::Case &scene);

} // namespace whirl::analyses
