#pragma once

#include "model/case.h"
#include "results/balance.h"

namespace whirl::analyses {

struct BalanceOptions {
    bool map = false; ///< the criterion over plane positions as well
};

/// Where passive auto-balancers in the correction planes of the case (without any: in the planes of
/// its balancers) can balance the rotor: the empirical criterion on the flexible rotor, per plane
/// and for all planes together, in bands of spin speed with refined ends; beside it the closed form
/// of the rigid rotor. The rotor is the one without balancers and rotating anisotropies. For
/// four-pendulum balancers their efficiency, too. Theory: docs/theory.md, "The criterion on a
/// flexible rotor". Collective over MPI processes: the signature is complete on process 0.
/// @throws model::BadInput without planes and balancers, without [speeds], or with negative ones;
///         model::AnalysisFailure where the rotor is free to move.
[[nodiscard]] results::BalanceResult balance(const model::Case &scene,
                                             const BalanceOptions &options = {});

} // namespace whirl::analyses
