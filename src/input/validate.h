#pragma once

#include "input/node.h"
#include "model/case.h"

#include <optional>

namespace whirl::input {

// Checks that concern several entries together. A number that was refused when it was read is nan;
// each check is a comparison that fails for nan, so one mistake gives one message.

/// The shear modulus belongs to 0 <= nu < 0.5, nu = E/(2G) - 1, and to `nu` within 1e-3 if given.
void check_shear_modulus(const model::Material &material, std::optional<double> nu,
                         const Origin &origin, const std::string &key, Problems &problems);

/// The bore is smaller than the outer diameter at both ends.
void check_segment(const model::Segment &segment, const Origin &origin, const std::string &key,
                   Problems &problems);
/// Collects a problem where what has mass is empty.
void check_mass_diameters(const model::Segment &segment, const Origin &origin,
                          const std::string &key, Problems &problems);

/// Checks of the whole scene: every z on the shaft, discs that a rigid body can be
/// (Ip <= 2 Id, mass where there is inertia), initial angles that fit the balancers. A z beyond an
/// end by less than 1e-9 of the shaft's length is moved to the end.
///
/// @param root  the case file, for the places of the entries
void validate(model::Case &scene, const Node &root, Problems &problems);

} // namespace whirl::input
