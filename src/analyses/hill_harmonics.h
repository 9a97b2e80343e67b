#pragma once

#include "analyses/arrangement.h"
#include "model/rotor.h"

#include <vector>

namespace whirl::analyses {

/// The fewest harmonics of the Hill series with which no motion below the spin speed, nor the
/// largest growth, changes by more than 1e-8 of the spin speed when one more is added; looked at at
/// the slowest (it needs most), a middle and the fastest of the speeds that are not zero.
/// @throws model::AnalysisFailure where the series does not settle.
[[nodiscard]] int settled_harmonics(const model::Rotor &rotor, int order,
                                    const Arrangement &arrangement,
                                    const std::vector<double> &speeds);

} // namespace whirl::analyses
