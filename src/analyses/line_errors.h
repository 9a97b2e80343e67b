#pragma once

#include "analyses/tracking.h"

#include <optional>
#include <vector>

namespace whirl::analyses {

/// For each line, at each speed, the estimated relative discretisation error.
using LineErrors = std::vector<std::vector<std::optional<double>>>;

/// Measured against a finer model at the first, a middle and the last speed, and between them
/// interpolated in the logarithm: the error of a mode changes slowly with speed. With a Hill series
/// the finer model has more harmonics as well.
[[nodiscard]] LineErrors line_errors(const model::Rotor &rotor, const SpectrumSolver &solver,
                                     int order, const std::vector<Line> &lines,
                                     const std::vector<Spectrum> &spectra);

} // namespace whirl::analyses
