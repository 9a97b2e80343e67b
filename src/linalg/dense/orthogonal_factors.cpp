#include "linalg/dense/orthogonal_factors.h"

#include "linalg/check.h"

#include <petscsys.h>
#include <slepcblaslapack.h>

#include <utility>
#include <vector>

namespace whirl::linalg {

OrthogonalFactors orthogonal_factors(Eigen::MatrixXd A) {
    if (!A.allFinite())
        throw SolverError("a matrix to be factored is not finite");
    auto rows = static_cast<PetscBLASInt>(A.rows());
    auto columns = static_cast<PetscBLASInt>(A.cols());
    PetscBLASInt room = 64 * columns; // blocks of that many
    PetscBLASInt failed = 0;
    std::vector<double> reflections(static_cast<std::size_t>(columns));
    std::vector<double> work(static_cast<std::size_t>(room));
    LAPACKgeqrf_(&rows, &columns, A.data(), &rows, reflections.data(), work.data(), &room, &failed);
    OrthogonalFactors out;
    out.R = Eigen::MatrixXd::Zero(A.cols(), A.cols());
    for (Eigen::Index j = 0; j < A.cols(); ++j)
        for (Eigen::Index i = 0; i <= j; ++i)
            out.R(i, j) = A(i, i) < 0 ? -A(i, j) : A(i, j);
    const Eigen::VectorXd diagonal = A.diagonal();
    LAPACKorgqr_(&rows, &columns, &columns, A.data(), &rows, reflections.data(), work.data(), &room,
                 &failed);
    for (Eigen::Index j = 0; j < A.cols(); ++j)
        if (diagonal(j) < 0)
            A.col(j) = -A.col(j);
    out.Q = std::move(A);
    return out;
}

} // namespace whirl::linalg
