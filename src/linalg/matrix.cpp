#include "linalg/matrix.h"

#include "linalg/check.h"

#include <petscmat.h>

namespace whirl::linalg {

void Matrix::Deleter::operator()(_p_Mat *handle) const noexcept { MatDestroy(&handle); }

Matrix Matrix::from_entries(int n, const std::vector<Eigen::Triplet<double>> &entries) {
    // The whole diagonal is stored: factorisations and shifts need it.
    std::vector<Eigen::Triplet<double>> all;
    all.reserve(entries.size() + static_cast<std::size_t>(n));
    all.assign(entries.begin(), entries.end());
    for (int i = 0; i < n; ++i)
        all.emplace_back(i, i, 0.0);
    // Sorted and summed here, PETSc has nothing to look for.
    Matrix out;
    out._rows = std::make_unique<Rows>(n, n);
    out._rows->setFromTriplets(all.begin(), all.end());
    Mat handle = nullptr;
    check(MatCreateSeqAIJWithArrays(PETSC_COMM_SELF, n, n, out._rows->outerIndexPtr(),
                                    out._rows->innerIndexPtr(), out._rows->valuePtr(), &handle));
    out._handle.reset(handle);
    return out;
}

Matrix Matrix::sum(double a, const Matrix &A, double b, const Matrix &B) {
    Mat handle = nullptr;
    check(MatDuplicate(A.handle(), MAT_COPY_VALUES, &handle));
    Matrix out;
    out._handle.reset(handle);
    check(MatScale(handle, a));
    check(MatAXPY(handle, b, B.handle(), DIFFERENT_NONZERO_PATTERN));
    return out;
}

Matrix Matrix::from_sparse(const Eigen::SparseMatrix<double> &A) {
    const Eigen::SparseMatrix<double, Eigen::RowMajor, PetscInt> rows = A;
    const auto n = static_cast<PetscInt>(rows.rows());
    std::vector<PetscInt> most(static_cast<std::size_t>(n));
    for (PetscInt i = 0; i < n; ++i)
        most[static_cast<std::size_t>(i)] =
            rows.outerIndexPtr()[i + 1] - rows.outerIndexPtr()[i] + 1;
    Mat handle = nullptr;
    check(MatCreateSeqAIJ(PETSC_COMM_SELF, n, n, 0, most.data(), &handle));
    Matrix out;
    out._handle.reset(handle);
    for (PetscInt i = 0; i < n; ++i) {
        const PetscInt first = rows.outerIndexPtr()[i];
        const PetscScalar zero = 0; // the whole diagonal is stored, as above
        check(MatSetValues(handle, 1, &i, 1, &i, &zero, INSERT_VALUES));
        check(MatSetValues(handle, 1, &i, rows.outerIndexPtr()[i + 1] - first,
                           rows.innerIndexPtr() + first, rows.valuePtr() + first, INSERT_VALUES));
    }
    check(MatAssemblyBegin(handle, MAT_FINAL_ASSEMBLY));
    check(MatAssemblyEnd(handle, MAT_FINAL_ASSEMBLY));
    return out;
}

int Matrix::size() const {
    if (!_handle)
        return 0;
    PetscInt n = 0;
    check(MatGetSize(handle(), &n, nullptr));
    return n;
}

SparseView Matrix::view() const {
    PetscInt n = 0;
    const PetscInt *rows = nullptr;
    const PetscInt *columns = nullptr;
    PetscBool done = PETSC_FALSE;
    const PetscScalar *values = nullptr;
    check(MatGetRowIJ(handle(), 0, PETSC_FALSE, PETSC_FALSE, &n, &rows, &columns, &done));
    check(MatSeqAIJGetArrayRead(handle(), &values));
    const SparseView out(n, n, rows[n], rows, columns, values);
    // Both calls below only end the bookkeeping; the arrays stay where they are.
    check(MatSeqAIJRestoreArrayRead(handle(), &values));
    check(MatRestoreRowIJ(handle(), 0, PETSC_FALSE, PETSC_FALSE, &n, &rows, &columns, &done));
    return out;
}

} // namespace whirl::linalg
