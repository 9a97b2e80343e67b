#pragma once

#include "linalg/check.h"
#include "linalg/eigenpair.h"
#include "linalg/matrix.h"

#include <memory>
#include <vector>

namespace whirl::linalg {

/// All eigenvalues were found, and rounding leaves too few digits of them: nothing finds more.
class Unresolved : public SolverError {
    using SolverError::SolverError;
};

/// Positive w of (K - w^2 A) x = 0, K symmetric positive definite, A symmetric, perhaps
/// indefinite or singular: mu = 1/w^2 are the positive eigenvalues of L^-1 A L^-T, K = L L^T.
/// The inertia of K - w0^2 A (its negative eigenvalues are the w below w0) proves that none is
/// missed.
class DefinitePair {
  public:
    /// @throws SolverError where K is not positive definite.
    DefinitePair(const Matrix &K, const Matrix &A);
    ~DefinitePair();
    DefinitePair(const DefinitePair &) = delete;
    DefinitePair &operator=(const DefinitePair &) = delete;
    DefinitePair(DefinitePair &&) = delete;
    DefinitePair &operator=(DefinitePair &&) = delete;

    /// The `wanted` smallest w (all, if there are fewer), ascending; x^T K x = 1.
    /// Where the count is not met, of as many unknowns as that takes seconds, by the dense solver.
    /// @throws SolverError where the inertia count cannot be met, Unresolved.
    [[nodiscard]] std::vector<RealPair> smallest(int wanted) const;

    /// Number of w below the bound.
    [[nodiscard]] int count_below(double bound) const;

  private:
    struct Factors;
    std::unique_ptr<Factors> _factors;

    /// The `wanted` smallest, by Krylov-Schur.
    [[nodiscard]] std::vector<RealPair> iterated(int wanted) const;
    [[nodiscard]] bool confirmed(const std::vector<RealPair> &pairs, std::size_t count) const;
};

} // namespace whirl::linalg
