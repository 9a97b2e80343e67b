#pragma once

#include "assembly/discretization.h"
#include "balancers/linear_element.h"
#include "modes/rotating/rotating_pencil.h"
#include "modes/rotating_spectrum.h"

#include <Eigen/Core>

#include <memory>
#include <optional>
#include <vector>

namespace whirl::modes {

/// Reduced rotor in rotating axes for a range of speeds: all eigenvalues of a speed from one small
/// dense problem, each then refined on the whole rotor.
class RotatingReducedRotor {
  public:
    /// A range of speeds, rad/s, and how many of the lowest modes are to be had there.
    struct Range {
        double from = 0, to = 0;
        int wanted = 0;

        [[nodiscard]] bool covers(const Range &other) const {
            return from <= other.from && to >= other.to && wanted >= other.wanted;
        }
    };

    /// The reduction basis holds the principal parts of the whole rotor's modes at speeds of the
    /// range; speeds are added until the modes half way between two of them are reproduced too.
    /// @param whole  with bearings the same at all speeds and from all sides
    /// @returns nothing where hardly fewer shapes than unknowns do, or where the whole rotor's
    ///          motions cannot be resolved
    [[nodiscard]] static std::unique_ptr<RotatingReducedRotor>
    of(const assembly::Discretization &discretization,
       const std::vector<balancers::BalancerElement> &balancers, const RotatingSpectrum &whole,
       const Range &range);

    [[nodiscard]] const Eigen::MatrixXd &shapes() const { return _shapes; } ///< N x r

    /// As of the whole rotor, with left vectors, at a speed of the range other than 0; nothing
    /// where one of them cannot be had from those of the reduced rotor.
    [[nodiscard]] std::optional<Spectrum> modes(double speed, int wanted);

  private:
    RotatingReducedRotor(const assembly::Discretization &discretization,
                         const std::vector<balancers::BalancerElement> &balancers,
                         const RotatingSpectrum &whole, Eigen::MatrixXd shapes, int wanted);

    const RotatingSpectrum &_whole;
    int _wanted;
    Eigen::MatrixXd _shapes;
    RotatingSpectrum _reduced;
    RotatingPencil _pencil;

    [[nodiscard]] bool meets(const RotatingSpectrum::Lowest &whole, double speed) const;
};

/// Modes of a rotor in rotating axes near guesses, one for each; none where they cannot be found
/// from these: two lead to one, or one to a motion of the other whirl.
[[nodiscard]] std::vector<WhirlMode> rotating_modes_near(const RotatingSpectrum &rotor,
                                                         RotatingPencil &pencil, double speed,
                                                         const std::vector<WhirlMode> &guesses);

} // namespace whirl::modes
