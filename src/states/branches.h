#pragma once

#include "results/steady_states.h"
#include "states/state_search.h"

#include <functional>
#include <optional>
#include <vector>

namespace whirl::states {

/// The states at one speed.
struct AtSpeed {
    double speed = 0; ///< rad/s
    std::vector<StateSearch::Found> states;
};

/// A state between two of one branch at a speed; none: it could not be followed.
using Between = std::function<std::optional<StateSearch::Found>(
    const StateSearch::Found &low, const StateSearch::Found &high, double speed)>;

/// The speeds between two states of one branch at which roots cross the imaginary axis: by halving
/// to this of the speed, where the number of those that grow differs.
inline constexpr double known_to = 1e-10;
void find_crossings(const StateSearch::Found &low, const StateSearch::Found &high,
                    const Between &between, std::vector<results::SteadyBorder> &out);

/// Numbers the states so that those of one number follow each other over the speeds, and finds the
/// speeds between them at which branches end and roots cross the imaginary axis: by halving, to the
/// digits that a double leaves of a fold. Of changes that undo each other between two speeds none
/// is seen.
/// @param all  ascending by speed; takes the numbers
void join_branches(const StateSearch &search, std::vector<AtSpeed> &all,
                   results::SteadyStates &out);

} // namespace whirl::states
