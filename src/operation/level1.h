#pragma once

#include "model/case.h"
#include "results/level1.h"
#include "results/sentence.h"

#include <vector>

namespace whirl::operation {

/// Level-I stability (API 617, API 684): at the maximum continuous speed cross coupling kxy = q,
/// kyx = -q, which drives forward whirl, is added at one place of the rotor.
/// `critical_cross_coupling` is the q with which the first of all motions begins to grow (as a rule
/// the first forward mode), a root of the whole rotor: all motions are followed over q as `ends`
/// does over the speed. `log_dec` is that of the same motion, followed continuously. Motions count
/// up to the frequency that the elements resolve, or twice the spin speed, and on a shaft of many
/// elements up to half the frequency of its sixteenth mode at rest. The checks and the verdict are
/// of the first of the motions that are no faster than twice the spin speed, or twice the first
/// mode at rest: `judged` where that is another one.
///
/// @param scene  with [operation] and [level1]
/// @param order  of the shaft elements
/// @param notes  what a user must know beside the numbers is added
/// @throws model::BadInput for rotors that are not axisymmetric; model::AnalysisFailure where
///         eigenvalues are not found.
[[nodiscard]] results::Level1 level1(const model::Case &scene, int order,
                                     std::vector<results::Sentence> &notes);

} // namespace whirl::operation
