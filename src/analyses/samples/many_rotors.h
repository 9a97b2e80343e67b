#pragma once

#include "analyses/case_with.h"
#include "analyses/samples/answers.h"
#include "results/samples.h"

#include <string>
#include <vector>

namespace whirl::analyses {

/// Answers of rotors that differ from the case in some entries.
struct ManyRotors {
    /// Those of the case as it is first; one value a rotor. Without quantiles.
    std::vector<results::SampledAnswer> answers;
    std::vector<results::SampleFailure> failures; ///< of what is no rotor, or has no answer
    int failed = 0;
};

/// The answers of each rotor, dealt out among MPI processes; the same for any number of them.
/// Collective; complete on process 0, empty on the others.
/// @param rotors  what each has of its own: "path=value"
/// @param what    they are, for progress and messages: "samples"
/// @throws model::AnalysisFailure where every one failed
[[nodiscard]] ManyRotors answers_of_many(const Answers &answers,
                                         const std::vector<std::vector<std::string>> &rotors,
                                         const std::string &what, const CaseWith &with);

} // namespace whirl::analyses
