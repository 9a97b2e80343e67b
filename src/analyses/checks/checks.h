#pragma once

#include "model/case.h"
#include "results/checks.h"
#include "results/critical.h"
#include "results/response.h"
#include "results/stability.h"

namespace whirl::analyses {

/// What was computed of a case, for its checks. What is missing is not judged, with the reason
/// given here or, without one, that it was not computed.
struct Computed {
    const results::ResponseResult *response = nullptr; ///< unbalance_response
    const results::CriticalResult *critical = nullptr; ///< critical_speeds
    /// stability over the speeds of the case, which judge only what they cover of the operating
    /// speeds (over_operation).
    const results::StabilityResult *stability = nullptr;
    results::Sentence no_response, no_critical, no_stability; ///< why the one above is missing
};

/// Whether the machine may run: every check that the case calls for, from results. Each is there
/// whether it can be judged or not. Without [operation] nothing is judged.
[[nodiscard]] results::Assessment assess(const model::Case &scene, const Computed &computed);

/// The case with speeds from the lowest operating speed to the highest one that it reaches, trip
/// speed or maximum: for a stability result that covers all of them.
/// @param scene  with [operation]
[[nodiscard]] model::Case over_operation(model::Case scene);

} // namespace whirl::analyses
