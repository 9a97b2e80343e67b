#pragma once

#include "model/case.h"
#include "results/simulate.h"

namespace whirl::analyses {

/// Nonlinear motion in time of the rotor with the balls and pendulums of its balancers; theory:
/// docs/theory.md, "Motion in time". Balls start at rest in the rotor, whirl at rest. The speed is
/// prescribed (constant or a run-up) or follows from a motor's torque. The shaft moves in few
/// shapes, whose error against the full model is part of the result.
///
/// A run that is interrupted (process/interruption.h) ends early with `restart` set; given as
/// `from` to a second call it goes on. Other starts of the case follow the first motion, each from
/// its beginning. Runs on process 0; the others return an empty result.
/// @throws model::BadInput where the case lacks something or asks for an absurd time span;
///         model::AnalysisFailure where the integration cannot go on.
[[nodiscard]] results::SimulateResult simulate(const model::Case &scene,
                                               const model::Restart *from = nullptr);

/// The motion from the first start of the case alone, by this process alone.
[[nodiscard]] results::SimulateResult simulate_alone(const model::Case &scene);

} // namespace whirl::analyses
