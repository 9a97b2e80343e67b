#pragma once

#include "assembly/discretization.h"
#include "balancers/linear_element.h"
#include "modes/rotating_spectrum.h"
#include "periodic/slow_motions.h"
#include "periodic/system.h"
#include "periodic/whole_root.h"

#include <Eigen/Core>

#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace whirl::modes {

/// Whirl modes of a rotor whose equations stay periodic in time (form hill) by its monodromy matrix
/// (periodic/): all motions of a speed at once, each shown by the alias that Hill's series would
/// show (series_pair.h). At speeds far below all frequencies, where half a turn takes long, they
/// are followed down from where the matrix resolves them (periodic/slow_motions.h). Where some die
/// out far within half a turn it is taken in triangular factors (periodic/triangular_turn.h). Where
/// half a turn takes too long and motions cannot be followed, as at rest, modes are those of Hill's
/// series.
class FloquetSpectrum {
  public:
    /// @param rotor      of form hill, on the same shapes; kept by reference
    /// @param balancers  at their balanced positions
    /// @param shapes     planar shapes, N x r, or none
    FloquetSpectrum(const assembly::Discretization &discretization, const RotatingSpectrum &rotor,
                    std::vector<balancers::BalancerElement> balancers,
                    std::shared_ptr<const Eigen::MatrixXd> shapes);

    /// At least the `wanted` modes with the lowest frequencies in the fixed frame, or all; at slow
    /// speeds, where the fastest of them would take too many steps, at least three quarters of
    /// them. Shapes over the planar unknowns of the discretization, vectors over those of the
    /// rotor.
    /// @throws linalg::SolverError
    [[nodiscard]] Spectrum modes(double speed, int wanted) const;

    /// Whether the monodromy matrix resolves that many modes at a speed: not near standstill, where
    /// half a turn takes too many steps. Hill's series has so many aliases of each motion there
    /// that it is slow, or does not find all.
    [[nodiscard]] bool resolves(double speed, int wanted) const;

    /// Whether rounding of the matrix hides some motions, so that a spectrum is found by the
    /// triangular factors of half a turn, which cost more.
    [[nodiscard]] bool loses_to_rounding(double speed, int wanted) const;

    /// At speeds up to this one all motions are at least five times as fast, rad/s; 0: nowhere.
    [[nodiscard]] double slow() const;

  private:
    const assembly::Discretization &_discretization;
    const RotatingSpectrum &_rotor;
    std::vector<balancers::BalancerElement> _balancers;
    std::shared_ptr<const Eigen::MatrixXd> _shapes;
    bool _tables;
    mutable periodic::KeptSystem _system;
    mutable std::map<int, std::unique_ptr<RotatingSpectrum>> _series; ///< by harmonics
    mutable double _series_speed = 0;     ///< with tables: whose bearings they have
    mutable std::map<int, double> _usual; ///< by modes: reach that was enough last time, rad/s

    /// Of the motions with the bearings' mean over the directions.
    struct Steady {
        std::vector<std::complex<double>> values;
        double fastest = 0; ///< rad/s
    };
    mutable std::map<int, Steady> _steady; ///< by powers of a speed's size

    /// Motions followed from a speed down.
    struct Followed {
        double from = 0;  ///< rad/s, of the sign of the speeds
        double reach = 0; ///< those up to this modulus as seen from the rotor are all there, rad/s
        std::optional<periodic::SlowMotions> motions;
    };
    mutable std::map<int, Followed> _followed; ///< by modes, negative for negative speeds
    mutable std::optional<double> _slow;       ///< speeds below are slow ones, rad/s

    [[nodiscard]] const periodic::System &system(double speed) const;
    [[nodiscard]] const Steady &steady(double speed) const;
    /// Modulus of the last of so many of them, the slowest ones, rad/s.
    [[nodiscard]] double slowest(double speed, int wanted) const;
    /// Steps in time for motions up to a modulus as seen from the rotor, and the logarithm of how
    /// far half a turn leads them apart; nothing where they would be too many.
    struct Steps {
        int count;
        double spread;
        int matter; ///< motions that do not die out far faster
    };
    [[nodiscard]] std::optional<Steps> steps_for(double speed, double reach) const;
    /// Motions of frequencies up to `fastest` by these steps.
    [[nodiscard]] std::optional<std::vector<periodic::FloquetSeries>>
    motions(double speed, const Steps &steps, double fastest) const;
    [[nodiscard]] Spectrum shown(double speed, const std::vector<periodic::FloquetSeries> &motions,
                                 double complete_radius) const;
    [[nodiscard]] std::optional<Spectrum> up_to(double speed, double reach, bool all) const;
    [[nodiscard]] std::optional<Spectrum> by_monodromy(double speed, int wanted) const;
    [[nodiscard]] Followed &followed(double speed, int wanted) const;
    [[nodiscard]] std::optional<Spectrum> by_following(double speed, int wanted) const;
    [[nodiscard]] const RotatingSpectrum &series(double speed, int harmonics) const;
    [[nodiscard]] Spectrum by_series(double speed, int wanted) const;
};

} // namespace whirl::modes
