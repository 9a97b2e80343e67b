#pragma once

#include "results/campbell.h"
#include "tracking/crossing_nodes.h"

#include <vector>

namespace whirl::tracking {

/// A band of speeds over which modes of periodic equations are locked on m times the spin speed.
struct LockedBand {
    results::Locked interval;
    double real_from = 0; ///< 1/s, of the two motions that meet at either end
    double real_to = 0;
};

/// Where two multipliers of periodic equations (rotor and bearings both anisotropic) meet on the
/// real axis, their frequencies stay on an integer multiple of the spin speed until they part again
/// (theory.md, Following modes). Such bands are looked for where a frequency changes sides of the
/// multiple between two speeds of the sweep, and from speeds inside one; ends inside the range are
/// to 1e-11 (branch_point.h). Modes at rest in rotating axes are left to intervals_locked_to_rotor.
/// @param multiple  of the spin speed, any: only integers have bands
[[nodiscard]] std::vector<LockedBand> locked_bands(const SweepNodes &sweep, double multiple);

} // namespace whirl::tracking
