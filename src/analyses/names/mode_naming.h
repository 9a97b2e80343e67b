#pragma once

#include "model/case.h"
#include "results/critical.h"
#include "results/response.h"

#include <vector>

namespace whirl::analyses {

/// Whether the lines of a case's Campbell diagram are followed to name critical speeds and peaks:
/// not in rotating axes, nor with balancers, where this takes seconds.
[[nodiscard]] bool names_at_little_cost(const model::Case &scene);

/// Names the mode of each critical speed, where its line of the Campbell diagram is sure.
/// @param order  of the shaft elements
void name_modes(std::vector<results::CriticalSpeed> &critical_speeds, const model::Case &scene,
                int order);

/// Names the mode that is nearest to resonance at each peak: the least |l - i speed|.
/// @param order  of the shaft elements
void name_modes(std::vector<results::ResponsePeak> &peaks, const model::Case &scene, int order);

} // namespace whirl::analyses
