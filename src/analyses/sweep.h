#pragma once

#include "analyses/case_with.h"
#include "results/sweep.h"

namespace whirl::analyses {

/// Answers of the case over one or two of its entries, or several that change together, as [sweep]
/// says. The case as it is comes first, with the errors of its numbers; the others have its
/// elements and no errors of their own. A rotor that cannot be or has no answer is listed with the
/// reason. Rotors are dealt out among MPI processes; complete on process 0, without answers
/// elsewhere.
/// @throws model::BadInput without [sweep], or where the answers wanted need more of the case;
///         model::AnalysisFailure where the case as it is has no answer, or every rotor failed.
[[nodiscard]] results::SweepResult sweep(const model::Case &scene, const CaseWith &with);

} // namespace whirl::analyses
