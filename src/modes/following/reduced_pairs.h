#pragma once

#include "linalg/dense_symmetric_factor.h"
#include "modes/following/reduced_model.h"

#include <vector>

namespace whirl::modes {

/// Factors of Q(l) beside a pair at another speed, and its coordinates there.
struct NearbyFactors {
    linalg::DenseSymmetricFactor factor;
    Eigen::VectorXcd coordinates;
};

/// Pairs of a reduced problem at one speed (values and coordinates) from guesses; `solved` are
/// those that took inverse iteration. Where eigenvalues nearly meet the vectors mix: guesses are
/// replaced first by the mixtures that the problem has in their span.
/// @param nearest  each at the nearest speed known; `mixed` are those that have turned far from it
/// @param slowest  so many of those that whirl are asked for; others are only counted
/// @param nearby   of each pair, from the last speed at which there was a factorisation: as long as
///                 these bring a pair near, there is no other
/// @returns false where one does not settle, turns far away from all guesses, or becomes another
/// one
[[nodiscard]] bool solve_reduced(const ReducedModel &model, double speed,
                                 std::vector<SymmetricPair> &pairs,
                                 const std::vector<const SymmetricPair *> &nearest, int slowest,
                                 std::vector<NearbyFactors> &nearby);

} // namespace whirl::modes
