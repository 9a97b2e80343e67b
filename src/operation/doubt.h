#pragma once

#include "model/case.h"
#include "results/sentence.h"

namespace whirl::operation {

/// Why what was computed is not judged.
struct Doubt {
    results::Sentence why;   ///< empty: it is
    bool either_way = false; ///< what fails neither: the machine is another one
};

/// Where the rotor computed is not the one that runs.
/// @param from,to  speeds that a judgement needs, rad/s
[[nodiscard]] Doubt doubt_of_rotor(const model::Case &scene, double from, double to);
/// At the operating speeds.
[[nodiscard]] Doubt doubt_of_rotor(const model::Case &scene);

} // namespace whirl::operation
