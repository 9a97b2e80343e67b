#pragma once

#include "model/case.h"
#include "results/held_motion.h"
#include "results/interval.h"
#include "results/sentence.h"
#include "simulation/equations.h"

#include <functional>
#include <optional>
#include <vector>

namespace whirl::analyses {

/// All steady states at these speeds (ascending), the motions told by those in which they came to
/// rest. None without balancers, and where it is not known: then a note says why.
[[nodiscard]] std::optional<results::SteadyStates>
match_states(const model::Case &scene, const std::vector<double> &speeds,
             const std::vector<results::HeldMotion *> &motions,
             std::vector<results::Sentence> &notes);

/// Says how many motions stand in states that do not keep.
void note_unstable(const std::vector<results::HeldMotion *> &motions,
                   const std::optional<results::SteadyStates> &states,
                   std::vector<results::Sentence> &notes);

/// Interval of 95 % for a probability of which `count` of `of` independent trials came out: that
/// of C. J. Clopper and E. S. Pearson (Biometrika 26 (1934) 404-413), which holds it at least as
/// often, whatever it is.
[[nodiscard]] results::Interval probability_interval(int count, int of);

/// Where the motions from [simulate.starts] end, judged by the last tenth of the time, or of a
/// sweep by the last speed. The starts are dealt out among the processes. Collective; complete on
/// process 0. Interrupted it ends early, and says so in the notes.
/// @param motion  on every process; its start angles are changed
/// @param first   what process 0 does meanwhile before its first start; false: nothing more is
///                wanted
/// @throws model::BadInput where the motions do not end at a constant prescribed speed.
[[nodiscard]] results::ManyStarts many_starts(const model::Case &scene,
                                              simulation::MotionScene &motion,
                                              const std::function<bool()> &first,
                                              std::vector<results::Sentence> &notes);

} // namespace whirl::analyses
