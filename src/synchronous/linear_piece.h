#pragma once

#include "linalg/eigenpair.h"

#include <Eigen/SparseCore>

#include <vector>

namespace whirl::synchronous {

/// A real root w of a symmetric Q(w) x = 0. As w grows, an eigenvalue of Q passes zero there.
struct CrossingPair {
    linalg::RealPair pair;
    bool downwards = true; ///< x^T Q'(w) x < 0: one more negative eigenvalue above the root
};

struct PieceRoots {
    std::vector<CrossingPair> roots; ///< ascending, multiple ones repeated
    bool complete = true; ///< all were resolved, and their signs agree with an inertia count
};

/// All real roots in [from, to] of Q(w) x = (K(w) - w^2 A) x = 0, K linear in w from `K_from` to
/// `K_to`, all symmetric and none definite: a quadratic eigenproblem about the middle of the piece,
/// complete up to the distance of its ends. The number of roots in a piece is no difference of
/// counts (an eigenvalue of Q may fall below zero and come back), but their signs must add up to
/// one: the inertia of Q at two speeds between the roots, the widest gaps, is compared.
///
/// @param from  not negative, below `to`
/// @throws SolverError
[[nodiscard]] PieceRoots roots_of_piece(const Eigen::SparseMatrix<double> &K_from,
                                        const Eigen::SparseMatrix<double> &K_to,
                                        const Eigen::SparseMatrix<double> &A, double from,
                                        double to);

/// Negative eigenvalues of a symmetric matrix by the signs of its pivots.
/// @throws SolverError where a pivot is zero.
[[nodiscard]] int negative_eigenvalues(const Eigen::SparseMatrix<double> &Q);

} // namespace whirl::synchronous
