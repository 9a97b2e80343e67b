#pragma once

#include "modes/whirl_mode.h"

#include <Eigen/Core>

#include <functional>
#include <utility>
#include <vector>

namespace whirl::modes {

class Stations;

/// Deflections x and y of a mode at stations.
using DeflectionsOf =
    std::function<std::pair<Eigen::VectorXcd, Eigen::VectorXcd>(const WhirlMode &)>;

/// Modes that share an eigenvalue (an isotropic rotor at rest) may be mixed at will; this turns
/// each such group into the circular whirls, forward and backward, that the smallest spin would
/// make of them. Expects modes sorted by frequency.
/// @param real  combinations of shapes must be real
void separate_degenerate(const DeflectionsOf &deflections, const Stations &stations, bool real,
                         std::vector<WhirlMode> &modes);

} // namespace whirl::modes
