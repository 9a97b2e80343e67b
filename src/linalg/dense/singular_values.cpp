#include "linalg/dense/singular_values.h"

#include "linalg/check.h"

#include <petscsys.h>
#include <slepcblaslapack.h>

#include <algorithm>
#include <complex>
#include <limits>

extern "C" { // not in PETSc's headers for complex numbers
void zgesvd_(const char *left, const char *right, const PetscBLASInt *n, const PetscBLASInt *m,
             std::complex<double> *A, const PetscBLASInt *lda, double *s, std::complex<double> *U,
             const PetscBLASInt *ldu, std::complex<double> *Vh, const PetscBLASInt *ldv,
             std::complex<double> *work, const PetscBLASInt *room, double *real_work,
             PetscBLASInt *failed);
}

namespace whirl::linalg {

SingularValues singular_values(Eigen::MatrixXcd A) {
    const Eigen::Index least = std::min(A.rows(), A.cols());
    SingularValues out{Eigen::MatrixXcd::Zero(A.rows(), least), Eigen::VectorXd::Zero(least),
                       Eigen::MatrixXcd::Zero(A.cols(), least)};
    if (least == 0)
        return out;
    if (!A.allFinite()) {
        constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
        out.U.setConstant(no_number);
        out.s.setConstant(no_number);
        out.V.setConstant(no_number);
        return out;
    }
    const auto n = static_cast<PetscBLASInt>(A.rows());
    const auto m = static_cast<PetscBLASInt>(A.cols());
    const auto k = static_cast<PetscBLASInt>(least);
    const PetscBLASInt room = 4 * (n + m) + 64 * std::max(n, m);
    Eigen::VectorXcd work(room);
    Eigen::VectorXd real_work(5 * least);
    Eigen::MatrixXcd Vh(least, A.cols());
    PetscBLASInt failed = 0;
    zgesvd_("S", "S", &n, &m, A.data(), &n, out.s.data(), out.U.data(), &n, Vh.data(), &k,
            work.data(), &room, real_work.data(), &failed);
    if (failed != 0)
        throw SolverError("singular values of a small matrix did not converge");
    out.V = Vh.adjoint();
    return out;
}

} // namespace whirl::linalg
