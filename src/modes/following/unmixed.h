#pragma once

#include "modes/following/eigenpair_refinement.h"
#include "modes/following/symmetric_problem.h"

#include <vector>

namespace whirl::modes {

/// Indices of pairs whose values lie close together, by groups of two and more.
[[nodiscard]] std::vector<std::vector<std::size_t>>
close_groups(const std::vector<SymmetricPair> &pairs);

/// Where eigenvalues nearly meet the vectors mix: guesses whose values lie close together are
/// replaced by the mixtures that the problem has in their span. Refined pairs stay.
/// @returns of each pair whether it was among such a group
[[nodiscard]] std::vector<bool> unmix(const SymmetricProblem &problem, double speed,
                                      std::vector<SymmetricPair> &pairs);

} // namespace whirl::modes
