#pragma once

#include "results/campbell.h"
#include "tracking/tracking.h"

#include <optional>
#include <vector>

namespace whirl::tracking {

struct Crossings {
    std::vector<results::Crossing> found; ///< ascending by speed within each multiple
    /// Of the speed of each of these, by how much finer elements change it, with safety, where this
    /// was asked for (form hill); none where it is not known from the motion there. Else empty.
    std::vector<std::optional<double>> by_mesh{};
    std::vector<results::Locked> locked; ///< ascending by their beginning within each multiple
    /// Steps in which a frequency changed sides of a multiple of the spin speed without a root
    /// that could be verified.
    std::vector<Gap> unsettled;
    /// Speeds of crossings and of ends of intervals that are those of a reduced rotor, not found
    /// with all unknowns, rad/s.
    std::vector<double> unconfirmed{};
};

/// Of each line whether it is drawn: among the `modes` lowest at some of these speeds, or crossing
/// a multiple, or staying on one.
[[nodiscard]] std::vector<char> lines_drawn(const std::vector<Line> &lines,
                                            const std::vector<modes::Spectrum> &spectra, int modes,
                                            const Crossings &crossed);

/// Spin speeds at which a line's frequency equals a multiple of the spin speed: roots, verified
/// with the model itself (relative 1e-11). Steps are split at the rows of bearing tables, and where
/// a line turns back within a step. Where a line stays on a multiple (motions that stand still in
/// an asymmetric rotor; a free rotor with Ip = m Id) that is an interval, of which only ends inside
/// the range are crossings. A line at zero frequency (a free rigid motion) crosses nothing.
/// @param spectra  ascending by speed
[[nodiscard]] Crossings crossings(const modes::SpectrumSolver &solver, const Tracking &tracking,
                                  const std::vector<modes::Spectrum> &spectra,
                                  const std::vector<double> &multiples);

} // namespace whirl::tracking
