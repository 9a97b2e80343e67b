#pragma once

#include "results/stability.h"
#include "stability/rotor_at_speeds.h"

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace whirl::stability {

/// For each anisotropy element the largest dI (the others as given) that leaves every speed of
/// `speeds` stable, by descent: from the largest dI that a body can have, each unstable band gives
/// the dI at which its strongest speed is just stable, until no band is left. This is done with a
/// rotor on few shapes; what comes out is found again with the whole rotor, and verified by the
/// search for bands, at it and just above. Beside it the
/// closed form of the rigid rotor (A. N. Gorbenko, On the permissible level of inertial anisotropy
/// of a gyroscopic rotor) where its supports are isotropic, symmetric about the centre of mass and
/// there is no balancer.
/// @param shapes  planar shapes that are good for the rotor as it is, where there are some
[[nodiscard]] std::vector<results::PermissibleAnisotropy>
permissible_anisotropies(const StabilityModel &model, const balancers::Arrangement &arrangement,
                         const std::vector<double> &speeds,
                         const std::shared_ptr<const Eigen::MatrixXd> &shapes = nullptr);

} // namespace whirl::stability
