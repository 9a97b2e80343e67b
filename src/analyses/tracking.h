#pragma once

#include "analyses/spectrum.h"

#include <vector>

namespace whirl::analyses {

/// A whirl mode followed over the spin speeds: its place in the spectrum of each speed, or
/// `absent` where it is overdamped or beyond the computed modes.
struct Line {
    static constexpr int absent = -1;
    std::vector<int> place;
};

/// Follows modes from speed to speed by their overlap in the energy product, so through crossings
/// and veerings. Where the overlap of a mode among the `important` lowest is ambiguous, speeds in
/// between are solved, down to 1/256 of the step.
[[nodiscard]] std::vector<Line> track(const SpectrumSolver &solver,
                                      const std::vector<Spectrum> &spectra, int important);

/// For each mode of `a` its continuation in `b` (or Line::absent).
[[nodiscard]] std::vector<int> continuation(const SpectrumSolver &solver, const Spectrum &a,
                                            const Spectrum &b, int important);

} // namespace whirl::analyses
