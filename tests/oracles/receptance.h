#pragma once

#include "oracles/wide_algebra.h"

#include <vector>

namespace whirl::oracles {

/// Deflections w = x + i y (m/N) at the places (m) under forces f exp(lambda t) there, f turning
/// forward: exact dynamic stiffness of the Timoshenko shaft, one block of the transfer matrix of
/// each length. Supports must be alike in all directions.
[[nodiscard]] ComplexMatrix receptance(const SteppedRotor &rotor, Complex lambda, Real speed,
                                       const std::vector<double> &places);

} // namespace whirl::oracles
