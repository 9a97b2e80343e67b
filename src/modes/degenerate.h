#pragma once

#include "modes/whirl_mode.h"

#include <vector>

namespace whirl::modes {

class SpectrumSolver;
class Stations;

/// Modes that share an eigenvalue (an isotropic rotor at rest) may be mixed at will; this turns
/// each such group into the circular whirls, forward and backward, that the smallest spin would
/// make of them. Expects modes sorted by frequency.
void separate_degenerate(const SpectrumSolver &solver, const Stations &stations,
                         std::vector<WhirlMode> &modes);

} // namespace whirl::modes
