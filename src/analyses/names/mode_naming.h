#pragma once

#include "model/case.h"
#include "results/critical.h"
#include "results/formulation.h"
#include "results/response.h"
#include "results/stability.h"

#include <vector>

namespace whirl::analyses {

/// Names the mode of each critical speed, where its line of the Campbell diagram is sure; none in
/// rotating axes, nor with balancers, where following the lines takes seconds.
/// @param order  of the shaft elements
void name_modes(std::vector<results::CriticalSpeed> &critical_speeds, const model::Case &scene,
                int order);

/// Names the mode that is nearest to resonance at each peak: the least |l - i speed|; none where
/// critical speeds get none.
/// @param order  of the shaft elements
void name_modes(std::vector<results::ResponsePeak> &peaks, const model::Case &scene, int order);

/// Names the mode that passes the imaginary axis at each end of kind pair; none at other ends,
/// where a motion stands still or two meet, nor where critical speeds get none, nor where the lines
/// of a large rotor can be followed neither on few shapes nor through few speeds.
/// @param form   in which the lines are followed
/// @param order  of the shaft elements
void name_modes(std::vector<results::StabilityEnd> &ends, const model::Case &scene,
                results::Form form, int order);

} // namespace whirl::analyses
