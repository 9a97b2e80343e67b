#include "results/held_motion.h"

#include <algorithm>

namespace whirl::results {

double HeldMotion::largest() const {
    const std::vector<double> &all = planes.empty() ? amplitude : planes;
    return all.empty() ? 0 : *std::ranges::max_element(all);
}

} // namespace whirl::results
