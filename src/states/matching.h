#pragma once

#include "model/rotor.h"
#include "results/held_motion.h"
#include "results/steady_states.h"

#include <optional>

namespace whirl::states {

/// The steady state at the speed of a motion in which its balancers have come to rest: that whose
/// masses, of each sort that could be exchanged, make the same imbalance to a twentieth of what
/// they make side by side; of families (members move into each other) all masses of a balancer
/// together. Of pendulums the angles are compared. None: they do not stand still, or elsewhere.
/// @returns its place among the states
[[nodiscard]] std::optional<std::size_t> matching_state(const model::Rotor &rotor,
                                                        const results::SteadyStates &states,
                                                        const results::HeldMotion &motion);

} // namespace whirl::states
