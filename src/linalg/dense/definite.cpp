#include "linalg/dense/definite.h"

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

std::optional<Eigen::VectorXd> symmetric_pair_values(Eigen::MatrixXd A, Eigen::MatrixXd B) {
    const auto n = static_cast<PetscBLASInt>(A.rows());
    const PetscBLASInt leading = std::max<PetscBLASInt>(n, 1);
    const PetscBLASInt kind = 1; // A x = l B x
    const PetscBLASInt room = 3 * leading;
    PetscBLASInt failed = 0;
    Eigen::VectorXd values(n);
    Eigen::VectorXd work(room);
    LAPACKsygv_(&kind, "N", "L", &n, A.data(), &leading, B.data(), &leading, values.data(),
                work.data(), &room, &failed);
    if (failed != 0)
        return std::nullopt;
    return values;
}

} // namespace whirl::linalg
