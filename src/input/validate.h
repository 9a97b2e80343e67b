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

/// Anisotropies leave principal inertias that a body can have, A1 = Id - |a|, A2 = Id + |a| and Ip
/// with each at most the sum of the others, a = sum of dI exp(2 i angle): at a place with discs
/// against the discs there (balls and point masses obey the inequalities by themselves, so adding
/// them mends nothing), elsewhere against the whole rotor.
void check_anisotropies(const model::Rotor &rotor, const Node &root, Problems &problems);

/// Given ball angles balance the imbalance: |sum exp(i a_j)/n + m0 R0/(n m R)| <= 1e-6; one ball
/// has a capacity E of 1. A capacity below 1 is no mistake here: the balls still move.
void check_ball_positions(const model::Rotor &rotor, const Node &root, Problems &problems);

/// Checks of the whole scene: every z on the shaft, discs that a rigid body can be
/// (Ip <= 2 Id, mass where there is inertia), initial angles that fit the balancers. A z beyond an
/// end by less than 1e-9 of the shaft's length is moved to the end.
///
/// @param root  the case file, for the places of the entries
void validate(model::Case &scene, const Node &root, Problems &problems);

} // namespace whirl::input
