#include "linalg/matrix.h"

namespace whirl::linalg {

Matrix Matrix::from_entries(int n, const std::vector<Eigen::Triplet<double>> &entries) {
    std::vector<Eigen::Triplet<double>> all;
    all.reserve(entries.size() + static_cast<std::size_t>(n));
    all.assign(entries.begin(), entries.end());
    for (int i = 0; i < n; ++i)
        all.emplace_back(i, i, 0.0);
    auto rows = std::make_unique<Rows>(n, n);
    rows->setFromTriplets(all.begin(), all.end());
    return Matrix(std::move(rows));
}

Matrix Matrix::from_sparse(const Eigen::SparseMatrix<double> &A) {
    Rows diagonal(A.rows(), A.rows());
    diagonal.setIdentity();
    return Matrix(std::make_unique<Rows>(Rows(A) + 0 * diagonal));
}

Matrix Matrix::sum(double a, const Matrix &A, double b, const Matrix &B) {
    return Matrix(std::make_unique<Rows>(a * *A._rows + b * *B._rows));
}

SparseView Matrix::view() const {
    return {_rows->rows(),          _rows->cols(),          _rows->nonZeros(),
            _rows->outerIndexPtr(), _rows->innerIndexPtr(), _rows->valuePtr()};
}

} // namespace whirl::linalg
