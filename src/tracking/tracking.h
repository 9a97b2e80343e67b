#pragma once

#include "tracking/mode_matching.h"

#include <Eigen/Core>

#include <map>
#include <optional>
#include <vector>

namespace whirl::tracking {

/// A whirl mode followed over the spin speeds: its place in the spectrum of each speed, or
/// `absent`, and then why.
struct Line {
    static constexpr int absent = -1; ///< no place in a spectrum
    std::vector<int> place;
    std::vector<Absence> absence;
};

/// Modes that could not be followed between two speeds.
struct Gap {
    double from = 0; ///< rad/s
    double to = 0;
    double frequency = 0; ///< of the mode, rad/s
};

/// Changes of the eigenvalues with speed at one speed, as in ModeBasis.
struct Rates {
    Eigen::VectorXcd below, above;
};

struct Tracking {
    std::vector<Line> lines;
    std::vector<Rates> rates; ///< of the modes of each speed
    std::vector<Gap> gaps;
    bool cut_short = false; ///< more speeds in between would have been solved than were allowed
};

/// Spectra by their speeds, rad/s, beside those that were asked for.
using SpectraBetween = std::map<double, modes::Spectrum>;

/// Lines through all spectra, by the left and right vectors of their modes. The number of speeds
/// solved in between is bounded by a multiple of the speeds given.
/// @param spectra       ascending by speed
/// @param most_between  another bound on that number
/// @param nodes         ascending; lines are followed from each of these speeds to the next, and
///                      others taken on the lines that pass there, so that these do not depend on
///                      which others there are. Empty: all are nodes; the first and the last always
/// @param known         solved in between before, for some of the same spectra: completed
[[nodiscard]] Tracking track(const modes::SpectrumSolver &solver,
                             const std::vector<modes::Spectrum> &spectra, int important,
                             std::optional<int> most_between = std::nullopt,
                             const std::vector<double> &nodes = {},
                             SpectraBetween *known = nullptr);

} // namespace whirl::tracking
