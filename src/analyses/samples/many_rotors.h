#pragma once

#include "analyses/samples/answers.h"
#include "model/case.h"
#include "results/samples.h"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace whirl::analyses {

/// Answers of rotors that differ from the case in some entries.
struct ManyRotors {
    /// Those of the case as it is first; one value a rotor. Without quantiles.
    std::vector<results::SampledAnswer> answers;
    std::vector<results::SampleFailure> failures; ///< of what is no rotor, or has no answer
    int failed = 0;
    std::vector<std::vector<double>> beside; ///< numbers of each; of one that failed none
};

/// One of many rotors. @param beside  may get numbers that go with it
/// @throws model::BadInput where there is no such rotor
using RotorOfMany = std::function<model::Case(std::size_t rotor, std::vector<double> &beside)>;

/// The answers of each rotor, dealt out among MPI processes; the same for any number of them.
/// Collective; complete on process 0, empty on the others.
/// @param what  they are, for progress and messages: "samples"
/// @throws model::AnalysisFailure where every one failed
[[nodiscard]] ManyRotors answers_of_many(const Answers &answers, std::size_t count,
                                         const RotorOfMany &rotor, const std::string &what);

} // namespace whirl::analyses
