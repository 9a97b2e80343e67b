#pragma once

#include "linalg/check.h"
#include "linalg/eigenpair.h"

#include <Eigen/Core>
#include <Eigen/Eigenvalues>

#include <functional>
#include <memory>
#include <utility>
#include <vector>

namespace whirl::linalg {

/// A symmetric operator of the given size: y = A z.
struct SymmetricOperator {
    int size = 0;
    std::function<void(const double *z, double *y)> apply;
    Eigen::VectorXd start; ///< of the iteration; must not depend on other solves
};

/// All its entries.
[[nodiscard]] Eigen::MatrixXd matrix_of(const SymmetricOperator &op);

void sort_by_modulus(std::vector<RealPair> &pairs);

/// Keeps the pairs, by modulus, up to the first gap behind so many of them in which there is room
/// for a shift, where the count agrees there: none is missing.
/// @param room         of the larger modulus
/// @param count_below  eigenvalues of less modulus than a bound
[[nodiscard]] bool keep_confirmed(std::vector<RealPair> &pairs, int wanted, double room,
                                  const std::function<int(double bound)> &count_below);

/// Negative pivots of L D L^T: as many as the matrix has negative eigenvalues.
/// @throws SolverError where a pivot is zero
template <class Factors> [[nodiscard]] int negative_pivots(const Factors &factors) {
    if (factors.info() != Eigen::Success)
        throw SolverError("an inertia count met a zero pivot");
    return static_cast<int>((factors.vectorD().array() < 0).count());
}

/// Components between 0.5 and 1.5, the same at every call.
[[nodiscard]] Eigen::VectorXd deterministic_vector(int size);

/// Finds eigenpairs of largest modulus again and again for operators of one size: what SLEPc sets
/// up for the first is kept for the others. Results do not depend on earlier solves.
class RepeatedEigensolver {
  public:
    RepeatedEigensolver();
    ~RepeatedEigensolver();
    RepeatedEigensolver(const RepeatedEigensolver &) = delete;
    RepeatedEigensolver &operator=(const RepeatedEigensolver &) = delete;
    RepeatedEigensolver(RepeatedEigensolver &&) = delete;
    RepeatedEigensolver &operator=(RepeatedEigensolver &&) = delete;

    /// @throws SolverError where fewer than `wanted` converge.
    [[nodiscard]] std::vector<std::pair<double, Eigen::VectorXd>>
    largest_magnitude(const SymmetricOperator &op, int wanted);

  private:
    struct Kept;
    std::unique_ptr<Kept> _kept;
};

/// Eigenpairs of largest modulus of a symmetric operator, orthogonal to `deflated`, by SLEPc's
/// Krylov-Schur; vectors have length 1.
/// @throws SolverError where fewer than `wanted` converge.
[[nodiscard]] std::vector<std::pair<double, Eigen::VectorXd>>
largest_magnitude(const SymmetricOperator &op, int wanted,
                  const std::vector<Eigen::VectorXd> &deflated);

/// The same for the algebraically largest eigenvalues.
[[nodiscard]] std::vector<std::pair<double, Eigen::VectorXd>>
largest_positive(const SymmetricOperator &op, int wanted,
                 const std::vector<Eigen::VectorXd> &deflated);

/// All eigenpairs, ascending, of the symmetric part of a full matrix.
/// @throws SolverError where the iteration does not converge.
[[nodiscard]] Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>
symmetric_eigenpairs(const Eigen::MatrixXd &A);

/// Singular values of a full square matrix, descending, and their left vectors.
struct LeftSingular {
    Eigen::VectorXd values;
    Eigen::MatrixXd vectors; ///< columns
};

/// By LAPACK's dgesvd. @throws SolverError where it does not converge.
[[nodiscard]] LeftSingular left_singular(Eigen::MatrixXd A);

} // namespace whirl::linalg
