#pragma once

#include "balancers/element.h"
#include "model/rotor.h"

#include <vector>

namespace whirl::balancers {

/// Ball angles in the rotor, one list for each balancer; empty for pendulums.
using Arrangement = std::vector<std::vector<double>>;

/// The balanced position of every balancer: the one the case gives, or the symmetric one.
/// @throws model::BadInput where a balancer has none.
[[nodiscard]] Arrangement arrangement_at_balance(const model::Rotor &rotor);

/// The balancers as linear elements with their balls at these angles.
[[nodiscard]] std::vector<BalancerElement> balancer_elements(const model::Rotor &rotor,
                                                             const Arrangement &arrangement);

/// At most `count` arrangements over the family of balanced positions, arrangement_at_balance
/// first; one alone where no balancer has a choice (two balls, pendulums, a full race).
[[nodiscard]] std::vector<Arrangement> sampled_arrangements(const model::Rotor &rotor, int count);

} // namespace whirl::balancers
