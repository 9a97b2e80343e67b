#pragma once

#include "analyses/case_with.h"
#include "model/case.h"
#include "results/machine_report.h"

namespace whirl::analyses {

/// Why a case does not call for an analysis; empty: it does. The critical speeds it always does.
struct NotCalledFor {
    results::Sentence campbell, response, stability, balance;
};
[[nodiscard]] NotCalledFor not_called_for(const model::Case &scene);

/// All analyses that a case calls for, and the checks that follow from them.
///
/// Each is the analysis of the command of its name, asked once. Shared: the critical speeds take
/// the peaks for their margins from the response; the checks take all three results as they are.
/// The response finds the critical speeds near its peaks itself, without errors: a tenth of the
/// time of `critical`. Stability is looked at a second time, over the operating speeds alone, where
/// the speeds of the case do not cover these. An analysis that fails costs its own part of the
/// report and leaves what hangs on it not judged. Collective under mpirun; complete on process 0.
/// @throws model::BadInput what an analysis finds wrong in the case
[[nodiscard]] results::MachineReport machine_report(const model::Case &scene, const CaseWith &with);

} // namespace whirl::analyses
