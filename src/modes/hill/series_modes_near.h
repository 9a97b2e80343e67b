#pragma once

#include "modes/rotating_spectrum.h"
#include "modes/whirl_mode.h"
#include "periodic/whole_root.h"

#include <vector>

namespace whirl::modes {

/// Modes of a rotor of form hill near guesses, one for each, by Hill's series with as many
/// harmonics as each needs (periodic/whole_root.h). A motion that stands still in the rotor, or
/// stays on a whole multiple of the spin speed, stays there.
/// @param rotor    the same, for the motion in the fixed frame
/// @param speed    rad/s
/// @param guesses  of which the eigenvalue in rotating axes and its vector (over the unknowns of
///                 this rotor, of any number of harmonics; or none) and the sense of whirl count
/// @returns none at rest, or where one does not converge, goes far away, two come to the same, or
///          one whirls the other way
[[nodiscard]] std::vector<WhirlMode> series_modes_near(const RotatingSpectrum &rotor,
                                                       const periodic::WholeRotor &whole,
                                                       double speed,
                                                       const std::vector<WhirlMode> &guesses);

/// A mode of a reduced rotor of form hill: its vector in rotating axes over all unknowns.
/// @param shapes    N x r planar shapes; none: it is
/// @param unknowns  of the reduced rotor
[[nodiscard]] WhirlMode over_all_unknowns(WhirlMode mode, const Eigen::MatrixXd *shapes,
                                          int unknowns);

} // namespace whirl::modes
