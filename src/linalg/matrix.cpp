#include "linalg/matrix.h"

#include "linalg/check.h"

namespace whirl::linalg {

Matrix Matrix::of(Rows rows) {
    rows.makeCompressed();
    Matrix out;
    out._rows = std::make_unique<const Rows>(std::move(rows));
    return out;
}

Matrix Matrix::from_entries(int n, std::vector<Eigen::Triplet<double>> entries) {
    // The whole diagonal is stored: factorisations and shifts need it.
    for (int i = 0; i < n; ++i)
        entries.emplace_back(i, i, 0.0);
    Rows rows(n, n);
    rows.setFromTriplets(entries.begin(), entries.end());
    return of(std::move(rows));
}

Matrix Matrix::from_sparse(const Eigen::SparseMatrix<double> &A) {
    Rows diagonal(A.rows(), A.rows()); // stored, as above
    diagonal.setIdentity();
    diagonal.coeffs().setZero();
    return of(Rows(A) + diagonal);
}

Matrix Matrix::sum(double a, const Matrix &A, double b, const Matrix &B) {
    if (A.size() != B.size())
        throw SolverError("matrices of different sizes have no sum");
    return of(a * A.view() + b * B.view());
}

int Matrix::size() const { return _rows ? static_cast<int>(_rows->rows()) : 0; }

SparseView Matrix::view() const {
    return {_rows->rows(),          _rows->cols(),          _rows->nonZeros(),
            _rows->outerIndexPtr(), _rows->innerIndexPtr(), _rows->valuePtr()};
}

} // namespace whirl::linalg
