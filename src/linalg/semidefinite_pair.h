#pragma once

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include <complex>
#include <optional>
#include <vector>

namespace whirl::linalg {

/// Positive w of (K - w^2 A) x = 0 in an interval; K symmetric (complex: Hermitian) positive
/// semidefinite, A likewise, perhaps indefinite.
///
/// At a root x^T A x = x^T K x / w^2 > 0, so that an eigenvalue of K - w^2 A only ever passes zero
/// downwards as w grows: the numbers of negative ones at two speeds (inertia by LDL^T) count the
/// roots between them. Bisection separates the roots, Rayleigh's quotient refines each (Parlett,
/// The Symmetric Eigenvalue Problem, chapters 3 and 4).
template <class Scalar> class CountedPair {
  public:
    using Sparse = Eigen::SparseMatrix<Scalar>;

    CountedPair(const Sparse &K, const Sparse &A);

    /// Negative eigenvalues of K - w^2 A.
    /// @throws SolverError where the factorisation breaks down.
    [[nodiscard]] int count_below(double w) const;

    /// The roots in (from, to), ascending, multiple ones repeated; relative error by rounding of K.
    /// @throws SolverError
    [[nodiscard]] std::vector<double> roots(double from, double to) const;

  private:
    Sparse _K;
    Sparse _A;
    mutable Eigen::SimplicialLDLT<Sparse> _factors;

    void factorise(double w) const;
    [[nodiscard]] std::optional<double> refined(double from, double to) const;
    void split(double from, int below, double to, int above, std::vector<double> &roots) const;
};

extern template class CountedPair<double>;
extern template class CountedPair<std::complex<double>>;

using SemidefinitePair = CountedPair<double>;
using HermitianPair = CountedPair<std::complex<double>>;

} // namespace whirl::linalg
