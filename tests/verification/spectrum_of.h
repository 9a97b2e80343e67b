#pragma once

#include "modes/spectrum.h"
#include "results/formulation.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace whirl::tests {

constexpr double rpm = std::numbers::pi / 30; ///< rad/s

inline modes::Spectrum spectrum_of(const model::Rotor &rotor, results::Form form, int order,
                                   double speed, int wanted, int refinement = 1) {
    return modes::SpectrumSolver(rotor, form, order, refinement).at(speed, wanted);
}

/// Frequencies (rad/s) of the first modes, ascending.
inline std::vector<double> frequencies(const modes::Spectrum &spectrum) {
    std::vector<double> out;
    for (const modes::WhirlMode &mode : spectrum.modes)
        out.push_back(mode.eigenvalue.imag());
    return out;
}

} // namespace whirl::tests
