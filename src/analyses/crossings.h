#pragma once

#include "analyses/tracking.h"

#include <vector>

namespace whirl::analyses {

/// Spin speeds at which a line's frequency equals a multiple of the spin speed, refined as roots
/// with the model itself (relative 1e-11), ascending by speed within each multiple. A line at
/// zero frequency (a free rigid motion) crosses nothing.
[[nodiscard]] std::vector<Crossing> crossings(const SpectrumSolver &solver,
                                              const std::vector<Line> &lines,
                                              const std::vector<Spectrum> &spectra,
                                              const std::vector<double> &multiples);

} // namespace whirl::analyses
