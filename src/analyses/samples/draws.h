#pragma once

#include "model/samples.h"

#include <vector>

namespace whirl::analyses {

/// The values of all uncertain inputs in one sample, in their order. They follow from the seed and
/// the number of the sample alone: not from the samples before it, nor from the process, nor from
/// inputs further down the list.
[[nodiscard]] std::vector<double> draw(const model::SamplesSettings &settings, int sample);

} // namespace whirl::analyses
