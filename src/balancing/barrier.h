#pragma once

#include "balancing/weights.h"

namespace whirl::balancing {

// Convex problems with |w| bounded in each plane, by the path of a logarithmic barrier: Newton's
// method in twice as many real unknowns as there are planes, each step a small dense system. What
// the path ends in is judged by a dual point, without regard to how it was found. All take the
// factors of the places as 1.

/// Weights and what no weights can be better than.
struct Certified {
    Eigen::VectorXcd w;
    double bound = 0;
};

/// w of least max |a + H w|. @param start  within the bounds, or beyond them
[[nodiscard]] Certified least_largest(const Balance &balance, const Eigen::VectorXcd &start);

/// w of least |a + H w|.
[[nodiscard]] Eigen::VectorXcd bounded_least_squares(const Balance &balance,
                                                     const Eigen::VectorXcd &start);
/// What |a + H w| cannot be less than, from the multipliers that w has.
[[nodiscard]] double least_squares_bound(const Balance &balance, const Eigen::VectorXcd &w);

} // namespace whirl::balancing
