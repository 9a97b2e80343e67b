#pragma once

#include "analyses/case_with.h"
#include "results/stability.h"

#include <functional>

namespace whirl::analyses {

/// Growth (largest real part, 1/s) over two entries of the case, one of which may be "speed"; with
/// neither, the largest growth over the speeds of the case (its grid, without the search for
/// narrow bands). Points are shared among MPI processes; complete on process 0.
///
/// Elastic rotors are looked at on few planar shapes that all rotors of the map share; the growth
/// at each point is an eigenvalue of the whole rotor, found next to that of the reduced one.
/// @param first  other work, of process 0 alone, which the others begin the map without; or none
[[nodiscard]] results::StabilityMap stability_map(const model::MapSettings &settings,
                                                  const CaseWith &with,
                                                  const std::function<void()> &first = {});

} // namespace whirl::analyses
