#pragma once

#include "results/campbell.h"
#include "tracking/tracking.h"

#include <vector>

namespace whirl::tracking {

struct Crossings {
    std::vector<results::Crossing> found; ///< ascending by speed within each multiple
    /// Steps in which a frequency changed sides of a multiple of the spin speed without a root
    /// that could be verified.
    std::vector<Gap> unsettled;
};

/// Spin speeds at which a line's frequency equals a multiple of the spin speed: roots, verified
/// with the model itself (relative 1e-11). Steps are split at the rows of bearing tables, and where
/// a line turns back within a step; of a band of speeds over which an asymmetric rotor holds a
/// frequency at the multiple the two ends are given (of bands narrower than 1/200 of the range only
/// where a line is followed into them). A line at zero frequency (a free rigid motion) crosses
/// nothing.
[[nodiscard]] Crossings crossings(const modes::SpectrumSolver &solver, const Tracking &tracking,
                                  const std::vector<modes::Spectrum> &spectra,
                                  const std::vector<double> &multiples);

} // namespace whirl::tracking
