#pragma once

#include "linalg/eigenpair.h"
#include "linalg/matrix.h"

#include <memory>
#include <vector>

namespace whirl::linalg {

/// Eigenvalues w of Q(w) x = (K + w s S - w^2 M) x = 0, K and M symmetric positive definite, S
/// symmetric, s a real parameter (the spin speed): all w are real, and 1/w are the eigenvalues of
///
///     H(s) = [-s L^-1 S L^-T,  L^-1 F;  F^T L^-T,  0],   K = L L^T,  M = F F^T,
///
/// symmetric, of size 2n. L and F do not depend on s: they are computed once for all speeds.
/// SLEPc's Krylov-Schur finds the wanted ends; the inertia of Q at two shifts then proves that no
/// eigenvalue was missed (Q(w0) has as many negative eigenvalues as there are w between 0 and w0).
class DefinitePencil {
  public:
    /// @throws SolverError where K or M is not positive definite.
    DefinitePencil(const Matrix &K, const Matrix &M, const Matrix &S);
    ~DefinitePencil();
    DefinitePencil(const DefinitePencil &) = delete;
    DefinitePencil &operator=(const DefinitePencil &) = delete;
    DefinitePencil(DefinitePencil &&) = delete;
    DefinitePencil &operator=(DefinitePencil &&) = delete;

    /// So many values of s are asked for next, here or by other processes: those that share them go
    /// the same way, and find the same to the last digit.
    void expect(int values);

    /// At least `wanted` eigenvalues (all, if there are fewer) of least modulus, by modulus;
    /// complete up to the last one returned, which the inertia count has confirmed.
    /// @throws SolverError where the count cannot be met.
    [[nodiscard]] std::vector<RealPair> smallest(double s, int wanted) const;

    /// Number of eigenvalues with 0 < w < bound plus those with -bound < w < 0.
    [[nodiscard]] int count_below(double s, double bound) const;

    /// Size n of the matrices.
    [[nodiscard]] int size() const;

  private:
    struct Factors;
    std::unique_ptr<Factors> _factors;

    [[nodiscard]] std::vector<RealPair> iterate(double s, int wanted) const;
    [[nodiscard]] std::vector<RealPair> dense(double s) const;
    [[nodiscard]] RealPair pair_from(double s, double mu, const Eigen::VectorXd &z) const;
    [[nodiscard]] bool confirmed(double s, std::vector<RealPair> &pairs, int wanted) const;
};

} // namespace whirl::linalg
