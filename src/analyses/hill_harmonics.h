#pragma once

#include "analyses/arrangement.h"
#include "model/rotor.h"

#include <vector>

namespace whirl::analyses {

/// How far a Hill series goes, and from which speed on that is enough.
struct HillSeries {
    int harmonics = 1;
    double from = 0; ///< rad/s, least |speed| that is described; slower needs more harmonics
};

/// The fewest harmonics of the Hill series with which no motion below the spin speed, nor a
/// growth, changes by more than 1e-8 of the spin speed when one more is added; looked at at the
/// slowest (it needs most), a middle and the fastest of the speeds. Harmonics lie 2 x speed apart,
/// so that at low speed none are enough: speeds are given up from below, by powers of two.
/// @throws model::AnalysisFailure where the series does not settle at the fastest speed either.
[[nodiscard]] HillSeries settled_series(const model::Rotor &rotor, int order,
                                        const Arrangement &arrangement,
                                        const std::vector<double> &speeds);

} // namespace whirl::analyses
