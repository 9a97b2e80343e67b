#pragma once

#include "tracking/bands/locked_whirl.h"

#include <optional>

namespace whirl::tracking {

/// An end of a band of locked motion in a part over which the number of these changes, for a Hill
/// series: its motions have no vectors over the equations of one speed to begin a double root with.
/// Of several ends in it one is found.
[[nodiscard]] std::optional<LockEnd> end_in_series(const modes::SpectrumSolver &solver,
                                                   const Count &from, const Count &to, int wanted);

} // namespace whirl::tracking
