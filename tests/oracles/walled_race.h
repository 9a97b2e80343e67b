#pragma once

#include "oracles/case_rotor.h"

#include <vector>

namespace whirl::oracles {

/// Two balls of a planar rotor in a race out of round with walls, turning with it as one body.
struct WalledPair {
    Real first = 0, second = 0; ///< angles in the rotor, rad
    int resting = 0;            ///< at a wall: the first, or both
    Real deflection = 0;        ///< m
    Real force = 0;             ///< of the first across its wall, N
};

/// All pairs with a ball at a wall: the first at one stop after the other (of each wall that before
/// it and that behind it), the second free, by rising deflection; then those with both at walls.
/// @throws std::runtime_error where the case is no such rotor
[[nodiscard]] std::vector<WalledPair> walled_pairs(const CaseRotor &rotor, Real speed);

/// How many pairs there are with both balls free: by Newton's method from a grid of starts.
[[nodiscard]] int free_pairs(const CaseRotor &rotor, Real speed);

} // namespace whirl::oracles
