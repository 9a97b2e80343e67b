#pragma once

#include "analyses/case_with.h"
#include "results/samples.h"

namespace whirl::analyses {

/// Answers of many rotors whose uncertain entries are drawn at random, as [samples] says. The case
/// as it is comes first, with the errors of its numbers; the samples have its elements and no
/// errors of their own. A sample that is no rotor or has no answer is listed with the reason.
/// Samples are dealt out among MPI processes, and are the same for any number of them; the result
/// is complete on process 0, without answers elsewhere.
/// @throws model::BadInput without [samples], or where the answers wanted need more of the case;
///         model::AnalysisFailure where the case as it is has no answer, or every sample failed.
[[nodiscard]] results::SamplesResult samples(const model::Case &scene, const CaseWith &with);

} // namespace whirl::analyses
