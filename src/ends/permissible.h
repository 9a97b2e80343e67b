#pragma once

#include "results/stability.h"
#include "stability/band_finder.h"
#include "stability/rotor_at_speeds.h"

#include <vector>

namespace whirl::ends {

/// For each anisotropy element the largest dI (the others as given) that leaves every speed of
/// `speeds` stable, by descent: from the largest dI that a body can have, each unstable band gives
/// the dI at which its strongest speed is just stable, until no band is left. Bands on the way are
/// those on the shapes of the rotor as it is; what comes out is verified on its own, at it and just
/// above. Beside it the closed form of the rigid rotor (A. N. Gorbenko, On the permissible level of
/// inertial anisotropy of a gyroscopic rotor) where its supports are isotropic, symmetric about the
/// centre of mass and there is no balancer.
///
/// Where the equations of an elastic rotor stay periodic in time, the bands of the rotor as it is,
/// or of the last unstable one of the descent, are followed to the dI at which the last of them
/// closes (periodic/neutral.h), and so are bands that the search then still finds, until it finds
/// none.
/// @param finder  with which the bands of the rotor as it is were found
[[nodiscard]] std::vector<results::PermissibleAnisotropy>
permissible_anisotropies(const stability::BandFinder &finder, const std::vector<double> &speeds,
                         const std::vector<results::Interval> &bands);

} // namespace whirl::ends
