#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <memory>
#include <type_traits>

namespace whirl::linalg {

/// L U of sparse matrices, real or complex, by KLU (T. A. Davis and E. Palamadai Natarajan,
/// Algorithm 907, ACM TOMS 37, 2010): without the dense blocks of other solvers, which matrices
/// along a chain have none of.
template <class Scalar> class SparseFactor {
  public:
    using Sparse = Eigen::SparseMatrix<Scalar>;
    using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;
    using Columns = Eigen::Ref<Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>>;

    /// @param keeps_pivots  matrices of the same pattern are eliminated with the pivots of the one
    ///                      before, too, which may not be good for them: for iterations that see
    ///                      whether they converge
    explicit SparseFactor(bool keeps_pivots = false);
    ~SparseFactor();
    SparseFactor(const SparseFactor &) = delete;
    SparseFactor &operator=(const SparseFactor &) = delete;

    /// The order of elimination is that of the last matrix where its entries stand at the same
    /// places.
    /// @param A  compressed
    /// @returns false where a pivot is zero: nothing is to be solved then
    [[nodiscard]] bool factorize(const Sparse &A);

    /// The next matrix gets pivots of its own.
    void forget_pivots();

    /// A^-1 b in the place of b.
    void solve(Columns b) const;
    /// A^-T b in the place of b.
    void solve_transposed(Columns b) const;

    /// A^-1 b and A^-H b.
    [[nodiscard]] Vector solution(Vector b) const {
        solve(b);
        return b;
    }
    [[nodiscard]] Vector adjoint_solution(const Vector &b) const {
        Vector x = b.conjugate();
        solve_transposed(x);
        return x.conjugate();
    }

    /// Of a real matrix.
    [[nodiscard]] bool negative_determinant() const requires std::is_same_v<Scalar, double>;
    /// Argument of the determinant of a complex matrix, rad.
    [[nodiscard]] double determinant_phase() const requires(!std::is_same_v<Scalar, double>);

  private:
    struct Data;
    std::unique_ptr<Data> _data;
};

} // namespace whirl::linalg
