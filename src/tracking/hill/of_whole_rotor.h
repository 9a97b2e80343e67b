#pragma once

#include "modes/spectrum.h"
#include "tracking/crossings.h"

#include <optional>
#include <utility>
#include <vector>

namespace whirl::tracking {

/// What was found with a rotor on few shapes (few), as the rotor with all unknowns (whole) has it;
/// both of form hill.
class OfWholeRotor {
  public:
    /// @param wanted  modes that are had at each speed
    OfWholeRotor(const modes::SpectrumSolver &whole, const modes::SpectrumSolver &few, int wanted)
        : _whole(whole), _few(few), _wanted(wanted) {}

    /// Some of the modes of a spectrum become those of the whole rotor, each that is found; the
    /// others are not confirmed (modes::WhirlMode).
    /// @param all  no others are looked for once one is not found
    /// @returns false where one of them is not found
    [[nodiscard]] bool improve(modes::Spectrum &spectrum, const std::vector<int> &places,
                               bool all) const;

    /// Crossings and ends of intervals. What is not found is said to be unconfirmed.
    /// @param low,high  ends of the range of speeds, which intervals may end at, rad/s
    void improve(Crossings &crossed, double low, double high) const;

  private:
    const modes::SpectrumSolver &_whole;
    const modes::SpectrumSolver &_few;
    int _wanted;

    /// The motion of the rotor on few shapes over the unknowns of the whole one.
    [[nodiscard]] modes::WhirlMode of_all_unknowns(const modes::WhirlMode &mode) const;

    /// A speed at which a line crosses or a band ends, and the real part there.
    struct Place {
        double speed = 0; ///< rad/s
        double real = 0;  ///< 1/s
    };
    /// A mode next to a multiple of the spin speed.
    struct Next {
        double speed = 0;    ///< rad/s
        double distance = 0; ///< of its frequency from the multiple, rad/s
        modes::WhirlMode mode;
    };
    /// Of the rotor on few shapes those that do not stand still, the nearest ones first.
    [[nodiscard]] std::vector<Next> next_to(double multiple, double speed) const;
    /// Just outside the end of a band, at one and at four times the distance, the mode that leaves
    /// it there.
    [[nodiscard]] std::optional<std::pair<Next, Next>> leaving(double multiple, double speed,
                                                               double near, double far) const;
    [[nodiscard]] std::optional<Next> of_whole(double multiple, const Next &few) const;
    using Found = std::vector<std::optional<modes::WhirlMode>>;
    [[nodiscard]] Found at_rest(const std::vector<modes::WhirlMode> &guesses) const;
    /// One by one: those next to their guesses, none of them met from two guesses.
    [[nodiscard]] Found at_speed(double speed, const std::vector<modes::WhirlMode> &guesses,
                                 bool all) const;
    [[nodiscard]] std::optional<Place> crossing(double multiple, double speed) const;
    [[nodiscard]] std::optional<Place> crossing(double multiple, double speed, double at,
                                                double step) const;
    [[nodiscard]] std::optional<Place> band_end(double multiple, double speed,
                                                double outwards) const;
};

} // namespace whirl::tracking
