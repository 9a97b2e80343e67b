#pragma once

#include "ends/all_motions.h"
#include "ends/refinement.h"
#include "results/stability.h"
#include "stability/rotor_at_speeds.h"

#include <vector>

namespace whirl::analyses {

/// A bearing or seal has negative damping, at some speed.
[[nodiscard]] bool has_negative_damping(const model::Rotor &rotor);

/// Something drives motions of every frequency: an axial torque without a potential, which does
/// work on every shape whose ends tilt, or negative damping in a bearing. The number of motions
/// that grow is then that of the unknowns, and the fast ones are not those of the shaft.
[[nodiscard]] bool drives_every_frequency(const model::Rotor &rotor);

/// AllMotions::count_resolved of such a rotor.
void count_resolved_if_driven(ends::AllMotions &motions, const model::Rotor &rotor);

/// Where motions are counted up to a frequency (AllMotions::count_resolved): moves the ends of
/// faster ones to `unresolved_ends`, counts in the others what is resolved, and finds their errors
/// by finer elements and the growth of the resolved motions.
/// @param roots  the motions at the ends that are known as roots
void tell_resolved_apart(const ends::AllMotions &motions, const stability::StabilityModel &model,
                         const std::vector<ends::WholeMotion> &roots,
                         results::StabilityResult &result);

} // namespace whirl::analyses
