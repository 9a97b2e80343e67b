#pragma once

#include "input/node.h"
#include "model/rotor.h"

namespace whirl::input {

// Checks of what turns with the rotor and is not axisymmetric. Numbers refused when they were read
// are nan, and every check is a comparison that fails for nan.

/// Anisotropies leave principal inertias that a body can have, A1 = Id - |a|, A2 = Id + |a| and Ip
/// with each at most the sum of the others, a = sum of dI exp(2 i angle): at a place with discs
/// against the discs there (balls and point masses obey the inequalities by themselves, so adding
/// them mends nothing), elsewhere against the whole rotor.
void check_anisotropies(const model::Rotor &rotor, const Node &root, Problems &problems);

/// Given ball angles balance the imbalance: |sum exp(i a_j)/n + m0 R0/(n m R)| <= 1e-6; one ball
/// has a capacity E of 1. A capacity below 1 is no mistake here: the balls still move.
void check_ball_positions(const model::Rotor &rotor, const Node &root, Problems &problems);

} // namespace whirl::input
