#pragma once

#include "modes/spectrum.h"

#include <cstddef>
#include <vector>

namespace whirl::tracking {

/// A speed, how many motions are locked there, and the others, those that turn least first.
struct Count {
    double speed = 0;
    std::ptrdiff_t motions = 0;
    std::vector<modes::WhirlMode> others;
};

[[nodiscard]] Count count_of(const modes::SpectrumSolver &solver, const modes::Spectrum &spectrum);
/// Of the `wanted` lowest modes at a speed.
[[nodiscard]] Count count_at(const modes::SpectrumSolver &solver, double speed, int wanted);

} // namespace whirl::tracking
