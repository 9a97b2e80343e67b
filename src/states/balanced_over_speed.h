#pragma once

#include "model/case.h"
#include "results/interval.h"
#include "results/steady_states.h"
#include "states/state_search.h"

#include <optional>
#include <vector>

namespace whirl::states {

/// What becomes of motions about a balanced position over a range of speeds.
struct BalancedRange {
    std::vector<results::Interval> grows;   ///< some grow, or it is not known
    std::vector<results::Interval> missing; ///< no such position: the masses cannot make it
    /// Inside the range: where roots begin or cease to grow, and where positions end (limit).
    std::vector<results::SteadyBorder> borders;
};

/// The balanced position of all balancers, in which none of their planes is deflected, where
/// imbalances elsewhere in the rotor ask for another one at every speed; docs/theory.md, "What
/// balancers must supply" and "Steady states".
class BalancedOverSpeed {
  public:
    /// @param speeds  at which it will be asked for, rad/s
    /// @throws model::AnalysisFailure as StateSearch; no balanced position is a matter of balls
    ///         alone (pendulums, one ball in a plane)
    BalancedOverSpeed(const model::Case &scene, const std::vector<double> &speeds);

    /// Arrangements that are looked at: the usual one, and where the masses have a choice others.
    [[nodiscard]] int arrangements(int most) const;
    /// Of the equations that it is found by: a reduced rotor.
    [[nodiscard]] int unknowns() const { return static_cast<int>(_search.equations().unknowns()); }
    /// Motions of masses beyond two in each plane, which change nothing.
    [[nodiscard]] int neutral_pairs() const;

    /// None at rest, and where the masses cannot make what is needed.
    /// @throws model::AnalysisFailure
    [[nodiscard]] std::optional<StateSearch::Found> at(double speed, int arrangement = 0) const;

    /// Between speeds both are found by halving; bands narrower than the steps are found where the
    /// growth has its largest or least value between them.
    /// @param speeds  ascending, at least two
    [[nodiscard]] BalancedRange over(const std::vector<double> &speeds, int arrangement = 0) const;

    /// Where the number of growing roots changes as it does at this border on this rotor: rad/s.
    /// None: not next to it.
    [[nodiscard]] std::optional<double> same_border(const results::SteadyBorder &border) const;

  private:
    StateSearch _search;
};

} // namespace whirl::states
