#include "linalg/dense/orthogonal_factors.h"

#include "linalg/check.h"

#include <Eigen/Cholesky>

#include <petscsys.h>
#include <slepcblaslapack.h>

#include <optional>
#include <utility>
#include <vector>

namespace whirl::linalg {

namespace {

/// A = Q R by the Cholesky factors of A^T A; none where A is nearly singular.
std::optional<OrthogonalFactors> by_cholesky(const Rows &A) {
    constexpr double nearly = 1e-7; // its square is above rounding: the second factors are good
    Rows gram(A.cols(), A.cols());
    set_product(Rows(A.transpose()), A, gram);
    const Eigen::LLT<Eigen::MatrixXd> factors{Eigen::MatrixXd(gram)};
    OrthogonalFactors out{{}, factors.matrixU()};
    const auto diagonal = out.R.diagonal().array();
    if (factors.info() != Eigen::Success || !(diagonal.minCoeff() > nearly * diagonal.maxCoeff()))
        return std::nullopt;
    Eigen::MatrixXd inverse = Eigen::MatrixXd::Identity(A.cols(), A.cols());
    out.R.triangularView<Eigen::Upper>().solveInPlace(inverse);
    out.Q.resize(A.rows(), A.cols());
    set_product(A, Rows(inverse), out.Q);
    return out;
}

/// By LAPACK's geqrf.
OrthogonalFactors by_reflections(Eigen::MatrixXd A) {
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

} // namespace

/// The first factors leave of Q what rounding makes of the condition's square, the second nothing
/// (Y. Yamamoto et al., Electronic Transactions on Numerical Analysis 44, 2015).
OrthogonalFactors orthogonal_factors(const Rows &A) {
    if (const auto first = by_cholesky(A))
        if (const auto second = by_cholesky(first->Q)) {
            Eigen::MatrixXd R = second->R.triangularView<Eigen::Upper>() * first->R;
            R.triangularView<Eigen::StrictlyLower>().setZero();
            return {second->Q, std::move(R)};
        }
    return by_reflections(A);
}

} // namespace whirl::linalg
