#pragma once

#include "tracking/tracking.h"

#include <optional>
#include <vector>

namespace whirl::tracking {

/// For each line, at each speed, the estimated relative discretisation error.
using LineErrors = std::vector<std::vector<std::optional<double>>>;

/// Measured against a finer model at the first, a middle and the last speed, and carried to the
/// others by the residual of the shapes (ShapeResidual), of which the error is a slowly varying
/// multiple even where modes veer. With a Hill series the finer model has more harmonics as well,
/// and the error is interpolated in the logarithm; speeds at which the finer modes are not found
/// from these, or these have many terms (next to rest), are left out. None where a mode is not
/// confirmed.
[[nodiscard]] LineErrors line_errors(const model::Rotor &rotor, const modes::SpectrumSolver &solver,
                                     const std::vector<Line> &lines,
                                     const std::vector<modes::Spectrum> &spectra);

} // namespace whirl::tracking
