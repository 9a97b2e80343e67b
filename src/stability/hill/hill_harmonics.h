#pragma once

#include "balancers/arrangement.h"
#include "model/rotor.h"

#include <vector>

namespace whirl::stability {

/// How far a Hill series goes, and from which speed on that is enough.
struct HillSeries {
    int harmonics = 1;
    double from = 0; ///< rad/s, least |speed| that is described; 0: all
};

/// From which of the speeds on Hill's series settles (hill_motions.h), and its harmonics there, the
/// most that are needed as a rule: they lie 2 x speed apart, so that at low speed none are enough.
/// Speeds are given up from below, by powers of two; those above are judged when they are used.
/// @throws NotSettled where the series does not settle at the fastest speed either.
[[nodiscard]] HillSeries settled_series(const model::Rotor &rotor, int order,
                                        const balancers::Arrangement &arrangement,
                                        const std::vector<double> &speeds);

} // namespace whirl::stability
