#include "analyses/notes/ball_positions.h"

#include "balancers/kind.h"

#include <algorithm>

namespace whirl::analyses {

bool balls_stand_elsewhere(const model::Rotor &rotor) {
    const auto counts = [](const model::Imbalance &imbalance) { return imbalance.mr != 0; };
    const auto off_centre = [](const model::Balancer &balancer) {
        return balancers::kind_of(balancer)->race_centre() != 0.0;
    };
    return !rotor.balancers.empty() && (std::ranges::any_of(rotor.imbalances, counts) ||
                                        std::ranges::any_of(rotor.balancers, off_centre));
}

void note_other_positions(const model::Rotor &rotor, std::vector<results::Sentence> &notes) {
    if (balls_stand_elsewhere(rotor))
        notes.emplace_back(model::Weight::warning,
                           "the balls stand here as against the imbalance of their own balancer "
                           "alone; [[imbalance]] entries or an eccentric race make them stand "
                           "elsewhere at each speed: "
                           "`balance` says where, `stability` whether they stay there");
}

} // namespace whirl::analyses
