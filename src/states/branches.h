#pragma once

#include "results/steady_states.h"
#include "states/state_search.h"

#include <vector>

namespace whirl::states {

/// The states at one speed.
struct AtSpeed {
    double speed = 0; ///< rad/s
    std::vector<StateSearch::Found> states;
};

/// Numbers the states so that those of one number follow each other over the speeds, and finds the
/// speeds between them at which branches end and roots cross the imaginary axis: by halving, to the
/// digits that a double leaves of a fold. Of changes that undo each other between two speeds none
/// is seen.
/// @param all  ascending by speed; takes the numbers
void join_branches(const StateSearch &search, std::vector<AtSpeed> &all,
                   results::SteadyStates &out);

} // namespace whirl::states
