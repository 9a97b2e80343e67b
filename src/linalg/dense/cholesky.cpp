#include "linalg/dense/cholesky.h"

#include <petscsys.h>
#include <slepcblaslapack.h>

#include <algorithm>

namespace whirl::linalg {

std::optional<Eigen::MatrixXd> cholesky(Eigen::MatrixXd A) {
    const auto n = static_cast<PetscBLASInt>(A.rows());
    const PetscBLASInt leading = std::max<PetscBLASInt>(n, 1);
    PetscBLASInt failed = 0;
    LAPACKpotrf_("L", &n, A.data(), &leading, &failed);
    if (failed != 0)
        return std::nullopt;
    for (Eigen::Index j = 1; j < A.cols(); ++j)
        A.col(j).head(j).setZero();
    return A;
}

} // namespace whirl::linalg
