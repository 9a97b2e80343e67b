#pragma once

#include "results/balance.h"
#include "results/campbell.h"
#include "results/checks.h"
#include "results/critical.h"
#include "results/model_summary.h"
#include "results/modes.h"
#include "results/response.h"
#include "results/sentence.h"
#include "results/show.h"
#include "results/stability.h"

#include <optional>

namespace whirl::results {

/// One analysis of a report: its result, or why there is none.
template <class Result> struct Part {
    std::optional<Result> result;
    Sentence why; ///< there is no result
    /// It was tried and failed; else the case does not call for it, or lacks what it needs.
    bool failed = false;
};

/// All that a case calls for, computed once.
struct MachineReport {
    ModelSummary model; ///< of `show`, which every case has
    Part<ShowResult> show;
    Part<CriticalResult> critical;
    Part<ResponseResult> response;
    Part<CampbellResult> campbell;
    Part<StabilityResult> stability;
    Part<ModesResult> modes; ///< at the highest operating speed, where there is one
    Part<BalanceResult> balance;
    Assessment assessment;
};

} // namespace whirl::results
