#include "linalg/dense/least_squares.h"

#include <petscsys.h>
#include <slepcblaslapack.h>

#include <algorithm>
#include <complex>
#include <limits>
#include <vector>

extern "C" { // not in PETSc's headers, or not for both kinds of numbers
void dgelsy_(const PetscBLASInt *n, const PetscBLASInt *m, const PetscBLASInt *k, double *A,
             const PetscBLASInt *lda, double *B, const PetscBLASInt *ldb, PetscBLASInt *pivots,
             const double *rounding, PetscBLASInt *rank, double *work, const PetscBLASInt *room,
             PetscBLASInt *failed);
void zgelsy_(const PetscBLASInt *n, const PetscBLASInt *m, const PetscBLASInt *k,
             std::complex<double> *A, const PetscBLASInt *lda, std::complex<double> *B,
             const PetscBLASInt *ldb, PetscBLASInt *pivots, const double *rounding,
             PetscBLASInt *rank, std::complex<double> *work, const PetscBLASInt *room,
             double *real_work, PetscBLASInt *failed);
}

namespace whirl::linalg {

namespace {

constexpr double rounding = std::numeric_limits<double>::epsilon();
constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

/// The sizes gelsy asks for.
struct Sizes {
    PetscBLASInt n, m, k;
    PetscBLASInt rows;  ///< of A
    PetscBLASInt taken; ///< rows of B, with room for the solutions
    PetscBLASInt room;  ///< to work column by column
    std::vector<PetscBLASInt> pivots;
    PetscBLASInt rank = 0, failed = 0;

    Sizes(Eigen::Index n_given, Eigen::Index m_given, Eigen::Index k_given)
        : n(static_cast<PetscBLASInt>(n_given)), m(static_cast<PetscBLASInt>(m_given)),
          k(static_cast<PetscBLASInt>(k_given)), rows(std::max<PetscBLASInt>(n, 1)),
          taken(std::max(rows, m)), room(4 * (n + m + k) + 1),
          pivots(static_cast<std::size_t>(m), 0) {}
};

} // namespace

Eigen::VectorXd least_squares(Eigen::MatrixXd A, const Eigen::VectorXd &b) {
    Sizes s(A.rows(), A.cols(), 1);
    if (!A.allFinite() || !b.allFinite())
        return Eigen::VectorXd::Constant(s.m, no_number);
    Eigen::VectorXd x = Eigen::VectorXd::Zero(s.taken);
    x.head(s.n) = b;
    Eigen::VectorXd work(s.room);
    dgelsy_(&s.n, &s.m, &s.k, A.data(), &s.rows, x.data(), &s.taken, s.pivots.data(), &rounding,
            &s.rank, work.data(), &s.room, &s.failed);
    return x.head(s.m);
}

Eigen::MatrixXcd least_squares(Eigen::MatrixXcd A, const Eigen::MatrixXcd &B) {
    Sizes s(A.rows(), A.cols(), B.cols());
    if (!A.allFinite() || !B.allFinite())
        return Eigen::MatrixXcd::Constant(s.m, s.k, no_number);
    Eigen::MatrixXcd X = Eigen::MatrixXcd::Zero(s.taken, s.k);
    X.topRows(s.n) = B;
    Eigen::VectorXcd work(s.room);
    Eigen::VectorXd real_work(2 * s.m + 1);
    zgelsy_(&s.n, &s.m, &s.k, A.data(), &s.rows, X.data(), &s.taken, s.pivots.data(), &rounding,
            &s.rank, work.data(), &s.room, real_work.data(), &s.failed);
    return X.topRows(s.m);
}

} // namespace whirl::linalg
