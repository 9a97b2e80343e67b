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
    static constexpr int absent = -1;
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

/// Follows modes from one speed to another, with more speeds in between where it must.
class ModeFollower {
  public:
    /// @param important  that many of the lowest modes must be followed
    /// @param budget     speeds that may be solved beside those given, in all
    /// @param finest     steps that are no longer are not halved to tell crossings from veerings
    ModeFollower(const modes::SpectrumSolver &solver, int important, int budget, double finest)
        : _solver(solver), _important(important), _budget(budget), _finest(finest) {}

    /// With the vectors of its modes.
    [[nodiscard]] Snapshot snapshot(modes::Spectrum spectrum) const;

    struct Followed {
        std::vector<int> to;            ///< places, or Matching::none
        std::vector<Absence> lost_from; ///< why a mode of a has no continuation
        std::vector<Absence> lost_to;   ///< why a mode of b has no origin
    };
    /// Modes of a in b. Where overlaps are ambiguous the step is halved, down to 1/256 of it, and
    /// there settled by groups of modes.
    [[nodiscard]] Followed follow(const Snapshot &a, const Snapshot &b);

    [[nodiscard]] const std::vector<Gap> &gaps() const { return _gaps; }
    /// The budget did not suffice.
    [[nodiscard]] bool cut_short() const { return _cut_short; }

  private:
    const modes::SpectrumSolver &_solver;
    int _important;
    int _budget;
    double _finest; // rad/s
    int _left_in_step = 0;
    bool _cut_short = false;
    std::vector<Gap> _gaps;

    [[nodiscard]] Followed follow(const Snapshot &a, const Snapshot &b, int depth);
    [[nodiscard]] Followed settle(const Snapshot &a, const Snapshot &b);
    void note_gaps(const Snapshot &a, const Snapshot &b, const Followed &followed);
};

/// Lines through all spectra, by the left and right vectors of their modes. The number of speeds
/// solved in between is bounded by a multiple of the speeds given.
/// @param most_between  another bound on it
[[nodiscard]] Tracking track(const modes::SpectrumSolver &solver,
                             const std::vector<modes::Spectrum> &spectra, int important,
                             std::optional<int> most_between = std::nullopt);

} // namespace whirl::tracking
