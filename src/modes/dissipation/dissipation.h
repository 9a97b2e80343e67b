#pragma once

#include "modes/spectrum.h"

#include <optional>
#include <string>
#include <vector>

namespace whirl::modes {

/// What one part takes from a motion Re(q exp(l t)): the power of its force against the motion,
/// mean over a cycle, with the factor exp(2 Re l t) that all of them have left out. Negative: it
/// feeds the motion.
struct PartPower {
    std::string of; ///< "bearing", "seal", "pedestal", "internal damping", "shaft damping",
                    ///< "axial torque", "balancer"
    std::optional<double> z; ///< m; none: along the shaft
    std::string name;
    double power = 0; ///< W, for the amplitudes of the mode's shape
};

/// Every part that can take or feed energy. The sum of the powers is -2 Re(l) times the energy of
/// the motion, 1/4 (|l|^2 q^H M q + q^H K q), as it follows from the equations; docs/theory.md,
/// "Where a mode dissipates". In rotating axes power and energy are those seen from the rotor.
/// Empty in the form hill.
[[nodiscard]] std::vector<PartPower> part_powers(const SpectrumSolver &solver,
                                                 const WhirlMode &mode, double speed);

} // namespace whirl::modes
