#pragma once

#include "support/random.h"
#include "support/scenes.h"

namespace whirl::tests {

/// One disc in either half of the shaft, of any size that a shaft of a metre carries.
inline void add_two_discs(Random &random, model::Rotor &rotor) {
    for (const double place : {random(0.1, 0.4), random(0.6, 0.9)})
        rotor.discs.push_back(disc_at(place * rotor.shaft.length(), random(5, 40),
                                      random(0.05, 0.2), random(0.1, 0.35)));
}

} // namespace whirl::tests
