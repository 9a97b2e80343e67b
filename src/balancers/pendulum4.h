#pragma once

#include "balancers/kind.h"
#include "model/rotor.h"

namespace whirl::balancers {

/// The pendulums of a balancer, for the analysis of their efficiency.
struct PlacedPendulums : model::Pendulums {
    std::string name;
    double z = 0;          ///< m
    std::size_t index = 0; ///< of the balancer in the rotor
};

[[nodiscard]] std::vector<PlacedPendulums> pendulums_in(const model::Rotor &rotor);

} // namespace whirl::balancers
