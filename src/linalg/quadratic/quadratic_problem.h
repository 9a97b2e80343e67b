#pragma once

#include "linalg/eigenpair.h"
#include "linalg/quadratic/quadratic_pattern.h"
#include "linalg/sparse_factor.h"

#include <Eigen/SparseCore>

#include <array>
#include <complex>
#include <optional>
#include <vector>

namespace whirl::linalg {

/// All finite eigenvalues with Im >= 0 of a small problem with full matrices, by the companion
/// matrix of the problem in 1/(l - shift), as the decomposition leaves them: errors are not known.
/// @throws SolverError where it does not converge
[[nodiscard]] std::vector<ComplexPair> all_pairs(const Eigen::MatrixXd &M, const Eigen::MatrixXd &D,
                                                 const Eigen::MatrixXd &K, double shift);

/// Q(l) = l^2 M + l D + K with a factorisation at one real shift: residuals and the dense route.
class QuadraticProblem {
  public:
    /// @throws SolverError where Q(shift) is singular.
    QuadraticProblem(const Eigen::SparseMatrix<double> &M, const Eigen::SparseMatrix<double> &D,
                     const Eigen::SparseMatrix<double> &K, double shift);

    [[nodiscard]] int size() const { return static_cast<int>(_M.rows()); }

    /// Normalises the vectors of the pairs and fills in their residuals and rounding, the latter
    /// with the right vectors in place of the left ones.
    void assess(std::vector<ComplexPair> &pairs) const;
    /// Left vectors, where they can be found, and with them residual and rounding of pairs once
    /// more: by what the eigenvalue is off to first order, and its condition. Double ones, which
    /// any vectors of a plane belong to, get the condition of the plane.
    void assess_condition(std::vector<ComplexPair> &pairs);

    /// All finite eigenvalues with Im >= 0, by the companion matrix of the problem in
    /// 1/(l - shift), scaled so that the eigenvalue nearest the shift is about 1.
    /// Remembered: they cost the cube of the unknowns.
    /// @param otherwise  by the other QR algorithm (general_eigen.h)
    [[nodiscard]] const std::vector<ComplexPair> &dense(bool otherwise);

  private:
    using Sparse = Eigen::SparseMatrix<double>;
    Sparse _M, _D, _K, _absM, _absD, _absK;
    double _shift;
    SparseFactor<double> _lu;

    std::optional<QuadraticPattern> _on_pattern;                 ///< made when first asked for
    SparseFactor<std::complex<double>> _near;                    ///< of Q next to an eigenvalue
    std::array<std::optional<std::vector<ComplexPair>>, 2> _all; ///< of dense(), by its argument

    void measure_condition(ComplexPair &pair);
    /// By two steps of inverse iteration with the transposed problem, of length 1; empty where it
    /// cannot be found.
    /// @param start  Q'(l) x, conjugate
    [[nodiscard]] Eigen::VectorXcd left_vector(std::complex<double> l, Eigen::VectorXcd start);

    /// An eigenvalue next to zero is known to a part of the shift: a Newton step with both vectors.
    /// @returns its rounding by the left vector too: 1, nothing known of it, for a zero that is
    ///          blurred, a double one above all, and looks like a small eigenvalue of its own
    [[nodiscard]] double polish_near_zero(ComplexPair &pair) const;
};

} // namespace whirl::linalg
