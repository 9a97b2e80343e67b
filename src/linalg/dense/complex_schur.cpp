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

} // namespace whirl::linalg
