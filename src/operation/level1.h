#pragma once

#include "model/case.h"
#include "results/formulation.h"
#include "results/level1.h"
#include "results/sentence.h"

#include <string>
#include <vector>

namespace whirl::operation {

/// Level-I stability (API 617, API 684): at the maximum
/// continuous speed cross coupling kxy = q, kyx = -q, which drives forward whirl, is added at one
/// place of the rotor. `critical_cross_coupling` is the q at which the first forward mode stops
/// dying out, a root of the whole model to 1e-10; `log_dec` is that of the same motion, followed
/// continuously. Heavily damped modes (AF < 2.5) are passed over; where bearings differ between
/// their directions the pair of modes is followed together out of which the forward one comes.
///
/// @param scene  with [operation] and [level1]
/// @param form   in which lines of the rotor without the coupling are followed
/// @param order  of the shaft elements
/// @param notes  what a user must know beside the numbers is added
/// @throws model::BadInput for rotors that are not axisymmetric; model::AnalysisFailure where
///         eigenvalues are not found.
[[nodiscard]] results::Level1 level1(const model::Case &scene, results::Form form, int order,
                                     std::vector<results::Sentence> &notes);

} // namespace whirl::operation
