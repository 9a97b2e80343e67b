#pragma once

#include "analyses/case_with.h"
#include "results/stability.h"

namespace whirl::analyses {

/// Growth (largest real part, 1/s) over two entries of the case, one of which may be "speed"; with
/// neither, the largest growth over the speeds of the case (its grid, without the search for
/// narrow bands). Points are shared among MPI processes; complete on process 0.
[[nodiscard]] results::StabilityMap stability_map(const model::MapSettings &settings,
                                                  const CaseWith &with);

} // namespace whirl::analyses
