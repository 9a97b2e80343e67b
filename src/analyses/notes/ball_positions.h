#pragma once

#include "model/case.h"
#include "results/sentence.h"

#include <vector>

namespace whirl::analyses {

/// [[imbalance]] entries, or races whose centre lies off the axis, ask the balls for other
/// positions than the balancers' own imbalances do.
[[nodiscard]] bool balls_stand_elsewhere(const model::Rotor &rotor);

/// Warns, then, of an answer with balls that stand against the imbalance of their own balancer.
void note_other_positions(const model::Rotor &rotor, std::vector<results::Sentence> &notes);

} // namespace whirl::analyses
