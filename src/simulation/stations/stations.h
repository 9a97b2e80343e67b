#pragma once

#include "model/case.h"
#include "results/simulate.h"

namespace whirl::simulation {

/// Beside the motion of each station that of the steady response to all imbalances there are at
/// the end, of balancers without their parts: at the last speed, its highest peak inside the speeds
/// passed (a root of the derivative, forced/response_peaks.h), and the curves; and the references
/// of balancers and stations, of a rotor without any imbalance under those that the parts make side
/// by side. A note where there is none.
void add_steady_response(const model::Case &scene, int order, results::SimulateResult &result);

/// Its name, or else where it is.
[[nodiscard]] results::Sentence place_of(const results::StationMotion &station);

/// How the motion of a rotor without balancers ended: fills outcome, evidence and trend. Steady:
/// over the last half the speed is constant, and the largest amplitude neither grows nor falls
/// (trend.h).
void classify_stations(const model::Case &scene, results::SimulateResult &result);

} // namespace whirl::simulation
