#pragma once

#include "input/node.h"
#include "model/case.h"

namespace whirl::input {

// Checks that concern several entries together. A number that was refused when it was read is nan;
// each check is a comparison that fails for nan, so one mistake gives one message.

/// Where the entries of a case stand and where mistakes go.
struct Check {
    const Node &tree; ///< the case as it was written
    Problems &problems;

    void fail(const std::string &path, std::string text) const {
        problems.add(origin_of(tree, path), path, std::move(text));
    }
};

/// Anisotropies leave principal inertias that a body can have, A1 = Id - |a|, A2 = Id + |a| and Ip
/// with each at most the sum of the others, a = sum of dI exp(2 i angle): at a place with discs
/// against the discs there (balls and point masses obey the inequalities by themselves, so adding
/// them mends nothing), elsewhere against the whole rotor.
void check_anisotropies(const model::Rotor &rotor, const Check &check);

/// Given ball angles balance the imbalance: |sum exp(i a_j)/n + m0 R0/(n m R)| <= 1e-6; one ball
/// has a capacity E of 1. A capacity below 1 is no mistake here: the balls still move. Those that
/// are held have one place, on balance or off it.
void check_ball_positions(const model::Case &scene, const Check &check);

/// Checks of the whole scene: every z on the shaft, discs that a rigid body can be
/// (Ip <= 2 Id, mass where there is inertia), initial angles that fit the balancers. A z beyond an
/// end by less than 1e-9 of the shaft's length is moved to the end.
void validate(model::Case &scene, const Check &check);

/// Adds to the remarks of a case what is allowed and looks like a slip: numbers that are a power of
/// ten or a unit away from any machine, speeds outside a bearing table, names given twice, a rotor
/// without bearings.
/// @param tree  the case as it was written: whether numbers have units
void add_remarks(model::Case &scene, const Node &tree);

} // namespace whirl::input
