#include "linalg/dense/complex_schur.h"

#include "linalg/check.h"

#include <petscsys.h>

#include <algorithm>
#include <complex>
#include <utility>
#include <vector>

extern "C" { // not in PETSc's headers for real numbers
void zgees_(const char *vectors, const char *sort, void *select, const PetscBLASInt *n,
            std::complex<double> *A, const PetscBLASInt *lda, PetscBLASInt *selected,
            std::complex<double> *values, std::complex<double> *Q, const PetscBLASInt *ldq,
            std::complex<double> *work, const PetscBLASInt *room, double *real_work,
            PetscBLASInt *flags, PetscBLASInt *failed);
void zgeev_(const char *left, const char *right, const PetscBLASInt *n, std::complex<double> *A,
            const PetscBLASInt *lda, std::complex<double> *values, std::complex<double> *U,
            const PetscBLASInt *ldu, std::complex<double> *V, const PetscBLASInt *ldv,
            std::complex<double> *work, const PetscBLASInt *room, double *real_work,
            PetscBLASInt *failed);
}

namespace whirl::linalg {

ComplexSchurForm complex_schur(Eigen::MatrixXcd A) {
    const auto n = static_cast<PetscBLASInt>(A.rows());
    if (n == 0)
        return {A, A};
    const PetscBLASInt room = 34 * n; // blocks of up to 33 columns
    Eigen::MatrixXcd Q(n, n);
    Eigen::VectorXcd values(n);
    Eigen::VectorXcd work(room);
    Eigen::VectorXd real_work(n);
    PetscBLASInt selected = 0;
    PetscBLASInt failed = 0;
    zgees_("V", "N", nullptr, &n, A.data(), &n, &selected, values.data(), Q.data(), &n, work.data(),
           &room, real_work.data(), nullptr, &failed);
    if (failed != 0)
        throw SolverError("the Schur form of a dense matrix was not found");
    A.triangularView<Eigen::StrictlyLower>().setZero();
    return {std::move(Q), std::move(A)};
}

ComplexEigen complex_eigen(Eigen::MatrixXcd A) {
    const auto n = static_cast<PetscBLASInt>(A.rows());
    if (n == 0)
        return {Eigen::VectorXcd(0), A, A};
    const PetscBLASInt room = 34 * n; // blocks of up to 33 columns
    ComplexEigen out{Eigen::VectorXcd(n), Eigen::MatrixXcd(n, n), Eigen::MatrixXcd(n, n)};
    Eigen::VectorXcd work(room);
    Eigen::VectorXd real_work(2 * static_cast<Eigen::Index>(n));
    PetscBLASInt failed = 0;
    zgeev_("V", "V", &n, A.data(), &n, out.values.data(), out.left.data(), &n, out.right.data(), &n,
           work.data(), &room, real_work.data(), &failed);
    if (failed != 0)
        throw SolverError("the eigenvalues of a dense complex matrix were not found");
    return out;
}

} // namespace whirl::linalg
