#pragma once

#include <Eigen/SparseCore>

#include <memory>
#include <utility>
#include <vector>

namespace whirl::linalg {

using SparseView = Eigen::Map<const Eigen::SparseMatrix<double, Eigen::RowMajor>>;

/// A square sparse matrix, built from a list of entries; its whole diagonal is stored, which
/// factorisations and shifts need.
class Matrix {
  public:
    Matrix() = default;
    /// n x n matrix; entries at equal places are summed.
    [[nodiscard]] static Matrix from_entries(int n,
                                             const std::vector<Eigen::Triplet<double>> &entries);
    [[nodiscard]] static Matrix from_sparse(const Eigen::SparseMatrix<double> &A);

    /// a A + b B.
    [[nodiscard]] static Matrix sum(double a, const Matrix &A, double b, const Matrix &B);

    /// Rows; 0 where there is no matrix (by default, or moved from).
    [[nodiscard]] int size() const { return _rows ? static_cast<int>(_rows->rows()) : 0; }

    /// The stored rows, without a copy; valid while this matrix lives unchanged.
    [[nodiscard]] SparseView view() const;

  private:
    using Rows = Eigen::SparseMatrix<double, Eigen::RowMajor>;
    std::unique_ptr<Rows> _rows;

    explicit Matrix(std::unique_ptr<Rows> rows) : _rows(std::move(rows)) {}
};

} // namespace whirl::linalg
