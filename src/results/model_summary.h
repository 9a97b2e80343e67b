#pragma once

#include "results/formulation.h"
#include "results/sentence.h"

#include <string>
#include <vector>

namespace whirl::results {

/// What every result says of the model behind it.
struct ModelSummary {
    Formulation formulation;
    int order = 0;               ///< of the shaft elements; 1: classical
    int elements = 0;            ///< of the shaft
    int unknowns = 0;            ///< of the eigenproblem or the linear systems
    double seconds = 0;          ///< wall time of the computation, from whoever asked for it
    std::vector<Sentence> notes; ///< what a user must know beside the numbers
    bool none = false;           ///< readings alone: of all that seconds, notes and why
};

} // namespace whirl::results
