#pragma once

#include <Eigen/SparseCore>

#include <memory>
#include <vector>

struct _p_Mat; // PETSc's matrix; its header stays inside linalg

namespace whirl::linalg {

using SparseView = Eigen::Map<const Eigen::SparseMatrix<double, Eigen::RowMajor>>;

/// A square sparse matrix owned by PETSc (sequential AIJ), built from a list of entries.
class Matrix {
  public:
    struct Deleter {
        void operator()(_p_Mat *handle) const noexcept;
    };

    Matrix() = default;

    /// n x n matrix; entries at equal places are summed.
    [[nodiscard]] static Matrix from_entries(int n,
                                             const std::vector<Eigen::Triplet<double>> &entries);

    [[nodiscard]] static Matrix from_sparse(const Eigen::SparseMatrix<double> &A);

    /// a A + b B.
    [[nodiscard]] static Matrix sum(double a, const Matrix &A, double b, const Matrix &B);

    /// Rows; 0 where there is no matrix (by default, or moved from).
    [[nodiscard]] int size() const;
    [[nodiscard]] _p_Mat *handle() const { return _handle.get(); }

    /// The stored rows, without a copy; valid while this matrix lives unchanged.
    [[nodiscard]] SparseView view() const;

  private:
    using Rows = Eigen::SparseMatrix<double, Eigen::RowMajor>;
    std::unique_ptr<Rows> _rows; ///< of which PETSc's matrix is made; none: it has its own
    std::unique_ptr<_p_Mat, Deleter> _handle;
};

} // namespace whirl::linalg
