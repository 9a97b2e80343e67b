#pragma once

#include "closed_form/pendulum_balancer.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace whirl::closed_form {

/// |phi|, |psi| < pi/4: no collisions between the pendulums.
[[nodiscard]] inline bool valid(const PendulumMotion &motion) {
    return std::max(std::abs(motion.phi), std::abs(motion.psi)) < std::numbers::pi / 4.0;
}

/// A steady motion on a branch over speed.
struct BranchPoint {
    double speed_ratio = 0.0;
    PendulumMotion motion;
};

/// The branch of steady motions through `start`, followed by arclength continuation, round its
/// folds, towards higher (heading 1) or lower (-1) speed until it leaves [from, to] (from > 0), a
/// deflection of ten arms or `largest_points`.
[[nodiscard]] std::vector<BranchPoint> steady_branch(const PendulumRotor &rotor,
                                                     const BranchPoint &start, double heading,
                                                     double from, double to,
                                                     int largest_points = 20000);

/// The branch that a run-up from `from` (below balancer_resonance) follows. With little damping it
/// turns away there to large deflections, and the well balanced motion at higher speed is a branch
/// of its own.
[[nodiscard]] std::vector<BranchPoint> steady_branch(const PendulumRotor &rotor, double from,
                                                     double to);

} // namespace whirl::closed_form
