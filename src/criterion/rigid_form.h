#pragma once

#include "results/balance.h"
#include "rigid/projection.h"

#include <optional>
#include <string>
#include <vector>

namespace whirl::criterion {

/// The rotor as a rigid body on its supports, and its critical speeds.
/// @param anisotropy  half the difference of its diametral inertias, kg m2
/// @param balancers   mass of the balancers, which are not in the body, kg
/// @returns none where the supports do not hold it.
[[nodiscard]] std::optional<results::RigidEquivalent>
rigid_equivalent(const rigid::RigidRotor &body, double anisotropy, double balancers);

/// Closed-form bands of one plane at z (m), cut to [from, to]; theory: rigid_rotor_criterion.h.
[[nodiscard]] std::vector<results::Interval>
rigid_plane_bands(const results::RigidEquivalent &rigid, double z, double from, double to);

/// The same for all planes together; planes at one place count once.
[[nodiscard]] std::vector<results::Interval>
rigid_joint_bands(const results::RigidEquivalent &rigid, const std::vector<double> &planes,
                  double from, double to);

} // namespace whirl::criterion
