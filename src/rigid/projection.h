#pragma once

#include "closed_form/composite_rotor.h"
#include "model/rotor.h"

#include <optional>
#include <string>

namespace whirl::rigid {

/// The rotor as a rigid body on its supports, about its centre of mass: (w, phi) with
/// [m 0; 0 A] (w, phi)'' - i speed [0 0; 0 C] (w, phi)' + [h_x h_y; h_y h_beta] (w, phi)'
/// + [c_x c_y; c_y c_beta] (w, phi) = 0.
struct RigidRotor {
    double mass = 0;   ///< kg
    double center = 0; ///< z of the centre of mass, m
    double A = 0;      ///< mean diametral inertia about it, kg m2
    double C = 0;      ///< polar inertia, kg m2
    closed_form::ReducedSupports supports;
};

/// Shaft, discs and bearings (as at `bearing_speed`) by exact projection on rigid motion; without
/// balancers and rotating anisotropies. Bearings by the mean of their coefficients over the
/// directions, pedestals as springs without mass in line with theirs; the damping without that of
/// pedestals.
[[nodiscard]] RigidRotor rigid_body(const model::Rotor &rotor, double bearing_speed);

/// The same where it leaves nothing out, bearings as at rest; none where a pedestal adds unknowns
/// or a bearing is not the same from every direction.
[[nodiscard]] std::optional<RigidRotor> rigid_projection(const model::Rotor &rotor);

/// Tilt does not move the centre of mass, nor the centre tilt the rotor: sums over z that vanish
/// but for this share.
[[nodiscard]] bool tilts_alone(const closed_form::ReducedSupports &supports, double rounding);

/// The bearings projected on rigid motion about a centre: sums of k, k z, k z^2 + kt, and of the
/// damping likewise. Empty, with the reason in `why`, for bearings that are not isotropic, that
/// depend on speed or stand on pedestals, and where there is no stiffness.
[[nodiscard]] std::optional<closed_form::ReducedSupports>
reduced_supports(const model::Rotor &rotor, double center, std::string &why);

} // namespace whirl::rigid
