#pragma once

#include "assembly/discretization.h"

#include <cstddef>

namespace whirl::stability {

/// The largest dI that a body can have, kg m2: no principal inertia exceeds the sum of the other
/// two, so that |2 dI| <= Ip, and none is negative, |dI| <= Id. Of the discs at the place of the
/// element, the other elements there taken into account; where no disc stands, of the whole rotor.
struct AnisotropyLimit {
    double dI = 0;
    bool of_disc = true; ///< a disc stands there
};
[[nodiscard]] AnisotropyLimit anisotropy_limit(const assembly::Discretization &discretization,
                                               std::size_t index);

} // namespace whirl::stability
