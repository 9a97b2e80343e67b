#pragma once

#include "modes/spectrum.h"
#include "results/formulation.h"

#include <Eigen/Core>

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace whirl::tracking {

/// The whirl of an asymmetric rotor that turns exactly with it, as over the band of speeds between
/// two of its critical speeds.
[[nodiscard]] bool locked(const modes::WhirlMode &mode, double speed);

/// How many motions of a spectrum do.
[[nodiscard]] std::ptrdiff_t locked_motions(const modes::Spectrum &spectrum);

/// A speed, how many motions are locked there, and the others, those that turn least first.
struct Count {
    double speed = 0;
    std::ptrdiff_t motions = 0;
    std::vector<modes::WhirlMode> others;
    /// Of the locked motions half of the least difference of real parts, 1/s.
    double split = std::numeric_limits<double>::infinity();
};
/// Half of the least difference of some numbers; infinite where there are less than two.
[[nodiscard]] double half_of_least_difference(std::vector<double> numbers);
[[nodiscard]] Count count_of(const modes::SpectrumSolver &solver, const modes::Spectrum &spectrum);
/// Of the `wanted` lowest modes at a speed.
[[nodiscard]] Count count_at(const modes::SpectrumSolver &solver, double speed, int wanted);

/// How fast a motion turns as seen from the rotor, rad/s; of a Hill series, where every motion has
/// aliases 2 speed apart, the slowest of them.
[[nodiscard]] double turn_in_rotor(const modes::WhirlMode &mode, double speed, results::Form form);

/// An end of a band of speeds over which a motion is locked.
struct LockEnd {
    double speed = 0;           ///< rad/s, relative 1e-11 or what rounding leaves
    double outside = 0;         ///< a speed close by at which the motion has left the band
    double real = 0;            ///< of the eigenvalue at the end, 1/s
    Eigen::VectorXd shape = {}; ///< form rotating: of the motion there
};

/// The same with the line of the motion outside the band.
struct BandEnd {
    double speed = 0;    ///< rad/s
    bool enters = false; ///< the band lies above this speed
    int line = 0;
};

/// Ends of such bands between two speeds of one sign, ascending, neither of them 0, over which the
/// number of locked motions among the `wanted` lowest modes changes: where two real eigenvalues in
/// rotating axes meet and part as a branch point does. (A number may also change where a motion is
/// too heavily damped to count as whirl, and by rounding where motions of the balls hardly differ.)
[[nodiscard]] std::vector<LockEnd> lock_ends(const modes::SpectrumSolver &solver, double from,
                                             double to, int wanted);

/// The same for a solver by_matrix() between two of its spectra, of speeds of one sign: also bands
/// that open and close between them.
/// @param rates_from,rates_to  of their modes, of this step; not a number where unknown
[[nodiscard]] std::vector<LockEnd> lock_ends(const modes::SpectrumSolver &solver,
                                             const modes::Spectrum &from,
                                             const Eigen::VectorXcd &rates_from,
                                             const modes::Spectrum &to,
                                             const Eigen::VectorXcd &rates_to);

/// The same over a whole range, which may hold 0, in 200 parts, and closely about each speed near
/// which the rotor without damping would have a motion stand still: a narrow band lies about one of
/// these. (Without such speeds, as with bearing tables, bands narrower than a part are left to
/// whoever follows a motion into them.)
[[nodiscard]] std::vector<LockEnd> lock_ends_over(const modes::SpectrumSolver &solver, double from,
                                                  double to, int wanted);

/// An end of a band of locked motion in a part over which the number of these changes, for a Hill
/// series: its motions have no vectors over the equations of one speed to begin a double root with.
/// Of several ends in it one is found.
[[nodiscard]] std::optional<LockEnd> end_in_series(const modes::SpectrumSolver &solver,
                                                   const Count &from, const Count &to, int wanted);

} // namespace whirl::tracking
