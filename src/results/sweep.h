#pragma once

#include "model/sweep.h"
#include "results/model_summary.h"
#include "results/samples.h"

#include <vector>

namespace whirl::results {

/// Answers over one or two entries of the case (analyses/sweep.h).
struct SweepResult {
    ModelSummary model; ///< of the case as it is
    std::vector<model::SweepAxis> axes;
    /// One value a rotor, without quantiles: the first axis runs fastest.
    std::vector<SampledAnswer> answers;
    /// Of each rotor the value, factor or shift of the entries of each axis; empty: no answer.
    std::vector<std::vector<double>> changes;
    std::vector<SampleFailure> failures; ///< by the numbers of the rotors, from 0
    int count = 0;
    int failed = 0;
};

} // namespace whirl::results
