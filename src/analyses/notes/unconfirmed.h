#pragma once

#include "modes/spectrum.h"
#include "results/campbell.h"
#include "results/model_summary.h"

#include <vector>

namespace whirl::analyses {

/// Whirl modes of a rotor whose equations stay periodic in time that are not confirmed
/// (modes::WhirlMode), next to rest.
/// @param few_shapes  they are those of the rotor on few shapes, else of a series cut off
void note_unconfirmed(results::ModelSummary &model, const std::vector<modes::Spectrum> &spectra,
                      bool few_shapes);

/// Crossings and intervals that are listed at some of these speeds (Crossings::unconfirmed).
void note_unconfirmed(results::CampbellResult &result, const std::vector<double> &speeds);

} // namespace whirl::analyses
