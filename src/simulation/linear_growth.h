#pragma once

#include "model/case.h"

#include <optional>
#include <vector>

namespace whirl::simulation {

/// What the eigenvalues promise for the balanced position: the largest real part, 1/s, of small
/// motions about it at a constant speed. None where there is no such position: a capacity below 1,
/// pendulums with an imbalance, an imbalance that belongs to no balancer, or a speed that a Hill
/// series does not describe.
///
/// @param angles  of the balls in the rotor, a list for each balancer: of the balanced positions of
///                more than two balls this one is taken where it is one to a twentieth, else that
///                of the case, or the symmetric one
[[nodiscard]] std::optional<double> linear_growth(const model::Case &scene, double speed,
                                                  const std::vector<std::vector<double>> &angles);

} // namespace whirl::simulation
