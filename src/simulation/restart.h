#pragma once

#include "model/case.h"
#include "model/restart.h"
#include "results/simulate.h"
#include "simulation/motion.h"

namespace whirl::simulation {

/// The state, in the unknowns of the whole rotor, and the series so far; the rest is not filled.
[[nodiscard]] model::Restart restart_of(const model::Rotor &rotor, const RotorMotion &motion,
                                        const double *state, const results::MotionSeries &series);

/// The state on the shapes of `motion`.
/// @param stations  how many are recorded
/// @throws model::BadInput where the restart belongs to another scene.
[[nodiscard]] Eigen::VectorXd state_of(const model::Restart &restart, const model::Case &scene,
                                       const RotorMotion &motion, std::size_t stations);

/// The time series of a restart that state_of() has accepted.
[[nodiscard]] results::MotionSeries series_of(const model::Restart &restart);

} // namespace whirl::simulation
