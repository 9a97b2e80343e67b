#pragma once

#include "tracking/tracking.h"

#include <vector>

namespace whirl::tracking {

/// Spectra at speeds and all lines through them.
struct FollowedLines {
    std::vector<modes::Spectrum> spectra;
    Tracking tracking;
};

/// Of each line whether it is among the `modes` lowest (Spectrum::lowest) at some speed.
[[nodiscard]] std::vector<char> among_lowest(const std::vector<Line> &lines,
                                             const std::vector<modes::Spectrum> &spectra,
                                             int modes);

/// How many modes are computed at each speed to begin with.
[[nodiscard]] int modes_to_follow(const model::Rotor &rotor, int modes);

/// Spectra with enough modes that no line that is among the `modes` lowest at some speed leaves
/// them. Collective; complete on process 0.
/// @param follow  as in spectra_at
/// @param nodes   as in track
/// @param known   on process 0: at some of the speeds, with modes_to_follow modes
/// @throws model::AnalysisFailure where modes are not found.
[[nodiscard]] FollowedLines followed_lines(const modes::SpectrumSolver &solver,
                                           const std::vector<double> &speeds, int modes,
                                           bool follow, const std::vector<double> &nodes = {},
                                           std::vector<modes::Spectrum> known = {});

/// How many modes to follow so that all are among them that are slower than a multiple of the spin
/// speed somewhere: as many as are at a speed, the largest of a range; no fewer than `modes`, and
/// no more than three times as many.
[[nodiscard]] int modes_below(const modes::SpectrumSolver &solver, double speed, double multiple,
                              int modes);

} // namespace whirl::tracking
