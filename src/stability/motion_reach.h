#pragma once

#include <vector>

namespace whirl::stability {

/// |l| up to which motions are slow enough to be looked at, 1/s: `least`, as much more as leaves
/// eight at each speed, and on into the widest gap up to twice as far.
/// @param sizes  |l| of all motions at some speeds over the range, a list each, in any order
[[nodiscard]] double motion_reach(std::vector<std::vector<double>> sizes, double least);

} // namespace whirl::stability
