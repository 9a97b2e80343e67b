#pragma once

#include "criterion/form.h"
#include "criterion/rotor.h"
#include "results/balance.h"

namespace whirl::criterion {

/// Errors of the ends of all bands: each end is found once more on a finer model of the rotor
/// (finer_order, same mesh), from the end on the given one; the error is estimate_safety times
/// the difference, and what finding it again on the given model changes (rounding). Zero for an end
/// of the range of speeds, none where the finer model has no such end. Bands that only one of the
/// two models has get a note.
/// @throws linalg::SolverError, model::AnalysisFailure
void judge_band_ends(const BalanceScene &scene, BalanceForm &form, results::BalanceResult &result);

} // namespace whirl::criterion
