#pragma once

#include "balancers/linear_element.h"
#include "model/rotor.h"

#include <vector>

namespace whirl::balancers {

/// Angles of balls and ring centres in the rotor, one list for each balancer; empty for pendulums.
using Arrangement = std::vector<std::vector<double>>;

/// The balanced position of every balancer: the one the case gives, or the usual one.
/// @throws model::BadInput where a balancer has none.
[[nodiscard]] Arrangement arrangement_at_balance(const model::Rotor &rotor);

/// The balancers as linear elements with their masses at these angles.
[[nodiscard]] std::vector<BalancerElement> balancer_elements(const model::Rotor &rotor,
                                                             const Arrangement &arrangement);

/// At most `count` arrangements over the family of balanced positions, arrangement_at_balance
/// first; one alone where no balancer has a choice (two balls, pendulums, a full race).
[[nodiscard]] std::vector<Arrangement> sampled_arrangements(const model::Rotor &rotor, int count);

} // namespace whirl::balancers
