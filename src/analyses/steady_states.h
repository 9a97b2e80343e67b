#pragma once

#include "analyses/case_with.h"
#include "model/case.h"
#include "results/sentence.h"
#include "results/steady_states.h"

#include <optional>
#include <vector>

namespace whirl::analyses {

/// The steady states that a case with [states] asks for: of all others none. Why there is no
/// answer is said in the notes.
/// @param with  for states over the entries of a [map] without y; none: over speeds
[[nodiscard]] std::optional<results::SteadyStates>
steady_states_of(const model::Case &scene, std::vector<results::Sentence> &notes,
                 const CaseWith &with = nullptr);

} // namespace whirl::analyses
