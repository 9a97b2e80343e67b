#include "linalg/dense/complex_factors.h"

#include <petscblaslapack.h>

#include <complex>
#include <type_traits>
#include <utility>

static_assert(std::is_same_v<PetscBLASInt, int>);

extern "C" { // not in PETSc's headers for real numbers
void zgetrf_(const PetscBLASInt *rows, const PetscBLASInt *columns, std::complex<double> *A,
             const PetscBLASInt *lda, PetscBLASInt *pivots, PetscBLASInt *failed);
void zgetrs_(const char *which, const PetscBLASInt *n, const PetscBLASInt *columns,
             const std::complex<double> *A, const PetscBLASInt *lda, const PetscBLASInt *pivots,
             std::complex<double> *B, const PetscBLASInt *ldb, PetscBLASInt *failed);
}

namespace whirl::linalg {

bool ComplexFactors::factorize(Eigen::MatrixXcd A) {
    _LU = std::move(A);
    const auto n = static_cast<PetscBLASInt>(_LU.rows());
    _pivots.resize(static_cast<std::size_t>(n));
    PetscBLASInt failed = 0;
    zgetrf_(&n, &n, _LU.data(), &n, _pivots.data(), &failed);
    return failed == 0;
}

Eigen::VectorXcd ComplexFactors::solved(char which, Eigen::VectorXcd b) const {
    const auto n = static_cast<PetscBLASInt>(_LU.rows());
    const PetscBLASInt one = 1;
    PetscBLASInt failed = 0;
    zgetrs_(&which, &n, &one, _LU.data(), &n, _pivots.data(), b.data(), &n, &failed);
    return b;
}

} // namespace whirl::linalg
