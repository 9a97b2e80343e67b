#include "linalg/dense/blas.h"

#include "linalg/check.h"

#include <petscsys.h>

#include <petscblaslapack.h>

#include <algorithm>
#include <vector>

namespace whirl::linalg {

namespace {

PetscBLASInt blas_size(Eigen::Index n) { return static_cast<PetscBLASInt>(n); }

/// beta C + A B in the place of C.
void multiply(double beta, Eigen::MatrixXd &C, const Eigen::MatrixXd &A, const Eigen::MatrixXd &B) {
    if (C.size() == 0)
        return;
    const PetscBLASInt rows = blas_size(C.rows());
    const PetscBLASInt columns = blas_size(C.cols());
    const PetscBLASInt inner = blas_size(A.cols());
    const PetscBLASInt of_B = std::max<PetscBLASInt>(inner, 1);
    const double one = 1;
    BLASgemm_("N", "N", &rows, &columns, &inner, &one, A.data(), &rows, B.data(), &of_B, &beta,
              C.data(), &rows);
}

} // namespace

Eigen::MatrixXd sum_with_product(Eigen::MatrixXd C, const Eigen::MatrixXd &A,
                                 const Eigen::MatrixXd &B) {
    multiply(1, C, A, B);
    return C;
}

Eigen::MatrixXd product(const Eigen::MatrixXd &A, const Eigen::MatrixXd &B) {
    Eigen::MatrixXd out(A.rows(), B.cols());
    multiply(0, out, A, B);
    return out;
}

Eigen::VectorXd product(const Eigen::MatrixXd &A, const Eigen::VectorXd &b) {
    Eigen::VectorXd out = Eigen::VectorXd::Zero(A.rows());
    if (A.size() == 0)
        return out;
    const PetscBLASInt rows = blas_size(A.rows());
    const PetscBLASInt columns = blas_size(A.cols());
    const PetscBLASInt step = 1;
    const double one = 1;
    BLASgemv_("N", &rows, &columns, &one, A.data(), &rows, b.data(), &step, &one, out.data(),
              &step);
    return out;
}

Eigen::MatrixXd solution(Eigen::MatrixXd A, Eigen::MatrixXd B) {
    const PetscBLASInt n = blas_size(A.rows());
    const PetscBLASInt columns = blas_size(B.cols());
    std::vector<PetscBLASInt> pivots(static_cast<std::size_t>(n));
    PetscBLASInt failed = 0;
    if (n > 0)
        LAPACKgesv_(&n, &columns, A.data(), &n, pivots.data(), B.data(), &n, &failed);
    if (failed != 0)
        throw SolverError("a dense linear system is singular");
    return B;
}

} // namespace whirl::linalg
