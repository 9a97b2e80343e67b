#pragma once

#include "model/sweep.h"
#include "results/sentence.h"

#include <optional>
#include <string>
#include <vector>

namespace whirl::results {

/// In place of a number of roots where the eigensolver found none.
inline constexpr int not_counted = -2;

/// A motion in which rotor and balancers turn as one body at a constant speed.
struct SteadyState {
    /// What the masses do.
    enum class Kind {
        balanced,        ///< no plane with balls is deflected
        partly_balanced, ///< some of these planes are not
        coincident,      ///< the balls of every plane stand at one angle
        split,           ///< some stand opposite to others of their plane
        swung,           ///< pendulums alone
        out_of_round,    ///< those of races out of round stand each where its own track holds it
        at_wall          ///< some ball rests against a wall across its race
    };
    double speed = 0; ///< rad/s
    double value = 0; ///< of what states are followed over, where that is an entry
    Kind kind = Kind::balanced;
    std::vector<std::vector<double>> angles; ///< of each balancer, in the rotor, rad
    /// Balls can move without a force: one point of a family stands for all.
    bool family = false;
    std::optional<bool> stable; ///< none: it is neither, or members of the family differ
    /// Largest real part of small motions about it, 1/s, of a family over those looked at; without
    /// the motions along the family.
    double growth = 0;       ///< NaN: not known
    double growth_error = 0; ///< how far rounding can move it, 1/s
    double least_growth = 0; ///< of a family, over those looked at
    int growing = 0;         ///< roots with a positive real part, or not_counted
    std::string why;         ///< stability is not known (of all members); empty: it is
    /// Of each balancer the forces of its balls on walls, N, 0 of one that rests at none; none of
    /// a balancer without walls.
    std::vector<std::vector<double>> wall_forces;
    std::vector<double> amplitudes; ///< of the planes of the balancers, m
    double residual = 0;            ///< the largest of them, m
    double defect = 0;              ///< what is left of the equations over the sizes of their terms
    int branch = 0;                 ///< states of one number follow each other over speed
};

/// "balanced", "partly balanced", "coincident", "split", "swung", "out of round" or "at wall".
[[nodiscard]] std::string steady_kind_name(SteadyState::Kind kind);

/// Where a branch ends, or motions about its states begin or cease to grow.
struct SteadyBorder {
    enum class Kind {
        fold,  ///< two branches meet and end
        limit, ///< the masses just reach: they stand at one angle, as those of another branch do
        zero,  ///< a real root passes zero: another branch passes through, as a rule
        pair,  ///< a complex pair crosses the imaginary axis (Hopf): a limit cycle begins
        undecided, ///< just beyond it was not found again: it may go on
        wall       ///< a ball meets a wall or ceases to press on it: the branch ends, or goes on as
                   ///< another
    };
    double speed = 0; ///< rad/s
    double value = 0; ///< of what states are followed over, where that is an entry
    Kind kind = Kind::fold;
    int branch = 0;
    /// Of a fold the second branch, of a wall the one that has the ball there or has it free.
    std::optional<int> other;
    /// Roots that grow just below this place; -1: no such state; or not_counted.
    int growing_below = 0;
    int growing_above = 0;           ///< likewise
    std::optional<double> frequency; ///< |Im| of the pair in turning axes, rad/s
    double residual = 0;             ///< of the state there, m
};

/// "fold", "limit", "zero", "pair", "undecided" or "wall".
[[nodiscard]] std::string steady_border_name(SteadyBorder::Kind kind);

struct SteadyStates {
    std::vector<double> speeds; ///< looked at, rad/s
    /// Entries of the case over which the states are followed at one speed; none: over the speeds.
    std::optional<model::SweepAxis> over;
    /// Over a dimensionless number the value, factor or shift of these at each of its values, else
    /// empty; NaN: there is no such rotor.
    std::vector<double> changes;
    std::vector<SteadyState> states;   ///< by speed, or by value
    std::vector<SteadyBorder> borders; ///< ascending; between the places looked at
    /// Places at which two states were too close to each other to be told apart, rad/s or values.
    std::vector<double> undecided;
    /// Places at which there is no such rotor, and why there is none at the last.
    std::vector<double> refused;
    std::string why_refused;
    std::vector<Sentence> notes;

    /// Along what they are followed. @param at  a state or a border
    [[nodiscard]] double place(const auto &at) const { return over ? at.value : at.speed; }
    [[nodiscard]] const std::vector<double> &places() const { return over ? over->values : speeds; }
};

} // namespace whirl::results
