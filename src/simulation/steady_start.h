#pragma once

#include "simulation/motion.h"

namespace whirl::simulation {

/// Deflections and velocities at time 0 of the steady motion under the eccentricities that are
/// there from the start: (p; p'), 4r entries.
/// @throws model::AnalysisFailure at a resonance without damping.
[[nodiscard]] Eigen::VectorXd steady_motion(const MovingParts &parts);

} // namespace whirl::simulation
