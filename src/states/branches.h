#pragma once

#include "results/steady_states.h"
#include "states/state_search.h"

#include <functional>
#include <optional>
#include <vector>

namespace whirl::states {

/// What branches are followed over: the spin speed, rad/s, or an entry of the case at one speed. A
/// place is a value of that.
class Followed {
  public:
    Followed() = default;
    Followed(const Followed &) = delete;
    Followed &operator=(const Followed &) = delete;
    virtual ~Followed() = default;
    /// Of the rotor there; good until some other one is asked for.
    [[nodiscard]] virtual const StateSearch &search(double place) = 0;
    [[nodiscard]] virtual double speed(double place) const = 0; ///< rad/s

    /// As of StateSearch, each with its place.
    [[nodiscard]] std::vector<StateSearch::Found> at(double place, bool &undecided);
    [[nodiscard]] std::vector<StateSearch::Found> of_way(int way, double place, bool &undecided,
                                                         StateSearch::Wanted wanted);
    [[nodiscard]] std::optional<StateSearch::Found>
    followed(const StateSearch::Found &from, const Eigen::VectorXd &guess, double place);
};

/// The states at one place.
struct AtPlace {
    double place = 0;
    std::vector<StateSearch::Found> states{};
    bool apart = false; ///< there is no rotor at the place before: branches begin anew
};

/// A state between two of one branch at a place; none: it could not be followed.
using Between = std::function<std::optional<StateSearch::Found>(
    const StateSearch::Found &low, const StateSearch::Found &high, double place)>;

/// The places between two states of one branch at which roots cross the imaginary axis: by halving
/// to this of the place, where the number of those that grow differs. A border's `speed` is the
/// place.
inline constexpr double known_to = 1e-10;
void find_crossings(const StateSearch::Found &low, const StateSearch::Found &high,
                    const Between &between, std::vector<results::SteadyBorder> &out);

/// Numbers the states so that those of one number follow each other over the places, and finds the
/// places between them at which branches end and roots cross the imaginary axis: by halving, to the
/// digits that a double leaves of a fold. Of changes that undo each other between two places none
/// is seen.
/// @param all  ascending by place; takes the numbers
void join_branches(Followed &over, std::vector<AtPlace> &all, results::SteadyStates &out);

} // namespace whirl::states
