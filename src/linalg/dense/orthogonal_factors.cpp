#include "linalg/dense/orthogonal_factors.h"

#include "linalg/check.h"

#include <petscsys.h>
#include <slepcblaslapack.h>

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
    const Eigen::VectorXd signs =
        (A.diagonal().array() < 0).select(-Eigen::ArrayXd::Ones(A.cols()), 1.0);
    OrthogonalFactors out;
    out.R = signs.asDiagonal() * A.topRows(A.cols());
    out.R.triangularView<Eigen::StrictlyLower>().setZero();
    LAPACKorgqr_(&rows, &columns, &columns, A.data(), &rows, reflections.data(), work.data(), &room,
                 &failed);
    out.Q = A * signs.asDiagonal();
    return out;
}

} // namespace whirl::linalg
