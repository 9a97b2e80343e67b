#include "analyses/notes/ball_positions.h"

#include "balancers/kind.h"

#include <algorithm>

namespace whirl::analyses {

bool balls_stand_elsewhere(const model::Rotor &rotor) {
    const auto counts = [](const model::Imbalance &imbalance) { return imbalance.mr != 0; };
    return !rotor.balancers.empty() && (std::ranges::any_of(rotor.imbalances, counts) ||
                                        balancers::has_eccentric_race(rotor.balancers));
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
