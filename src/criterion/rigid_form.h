#pragma once

#include "model/rotor.h"
#include "results/balance.h"

#include <optional>
#include <string>
#include <vector>

namespace whirl::criterion {

/// The rotor as a rigid body on its supports: mass and stiffness of the rigid motions of the same
/// shaft, discs and bearings. The mean of the x and y stiffness counts; pedestals are springs in
/// series without their masses; bearing tables are read at `bearing_speed` (rad/s).
/// @returns none where the supports do not hold a rigid rotor.
[[nodiscard]] std::optional<results::RigidEquivalent> rigid_equivalent(const model::Rotor &rotor,
                                                                       double bearing_speed);

/// Mass of shaft and discs, kg.
[[nodiscard]] double rotor_mass(const model::Rotor &rotor);

/// Closed-form bands of one plane at z (m), cut to [from, to]; theory: rigid_rotor_criterion.h.
[[nodiscard]] std::vector<results::SpeedBand>
rigid_plane_bands(const results::RigidEquivalent &rigid, double z, double from, double to);

/// The same for all planes together; planes at one place count once.
[[nodiscard]] std::vector<results::SpeedBand>
rigid_joint_bands(const results::RigidEquivalent &rigid, const std::vector<double> &planes,
                  double from, double to);

} // namespace whirl::criterion
