#pragma once

#include "tracking/tracking.h"

#include <vector>

namespace whirl::tracking {

/// Spectra at speeds and all lines through them.
struct FollowedLines {
    std::vector<modes::Spectrum> spectra;
    Tracking tracking;
};

/// The line is among the `modes` lowest at some speed.
[[nodiscard]] bool among_lowest(const Line &line, int modes);

/// How many modes are computed at each speed to begin with.
[[nodiscard]] int modes_to_follow(const model::Rotor &rotor, int modes);

/// Spectra with enough modes that no line that is among the `modes` lowest at some speed leaves
/// them. Collective; complete on process 0.
/// @param follow  as in spectra_at
/// @throws model::AnalysisFailure where modes are not found.
[[nodiscard]] FollowedLines followed_lines(const modes::SpectrumSolver &solver,
                                           const std::vector<double> &speeds, int modes,
                                           bool follow);

} // namespace whirl::tracking
