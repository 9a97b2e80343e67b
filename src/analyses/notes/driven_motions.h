#pragma once

#include "ends/all_motions.h"
#include "ends/refinement.h"
#include "results/stability.h"
#include "stability/rotor_at_speeds.h"

#include <vector>

namespace whirl::analyses {

/// AllMotions::count_resolved of a rotor in which something drives motions of every frequency: an
/// axial torque without a potential or negative damping in a bearing.
void count_resolved_if_driven(ends::AllMotions &motions, const model::Rotor &rotor);

/// Where motions are counted up to a frequency (AllMotions::count_resolved): moves the ends of
/// faster ones to `unresolved_ends`, counts in the others what is resolved, and finds their errors
/// by finer elements and the growth of the resolved motions.
/// @param roots  the motions at the ends that are known as roots
void separate_resolved(const ends::AllMotions &motions, const stability::StabilityModel &model,
                       const std::vector<ends::EndOfGrowth> &roots,
                       results::StabilityResult &result);

/// Notes on what drives the motions that grow, where it drives fast ones: an axial torque that has
/// no potential (how much is left where it has one), a bearing with negative damping.
void note_drives(const stability::StabilityModel &model, results::StabilityResult &result);

} // namespace whirl::analyses
