#include "benchmarks/dense_baseline.h"
#include "assembly/system.h"
#include "benchmarks/stopwatch.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <stdexcept>

extern "C" void dgeev_(const char *left, const char *right, const int *n, double *a, const int *lda,
                       double *re, double *im, double *vl, const int *ldvl, double *vr,
                       const int *ldvr, double *work, const int *lwork, int *info);

namespace whirl::benchmarks {

namespace {

Eigen::MatrixXd state_matrix(const model::Rotor &rotor, int order, int refinement, double speed) {
    const assembly::Discretization discretization(rotor, order, refinement);
    const assembly::FixedSystem system = assembly::assemble_fixed(discretization, speed);
    const Eigen::LLT<Eigen::MatrixXd> mass(Eigen::MatrixXd(system.M.view()));
    const int n = system.M.size();
    Eigen::MatrixXd state = Eigen::MatrixXd::Zero(2 * n, 2 * n);
    state.topRightCorner(n, n).setIdentity();
    state.bottomLeftCorner(n, n) =
        -mass.solve(Eigen::MatrixXd(system.K.view()) + speed * Eigen::MatrixXd(system.Kc.view()));
    state.bottomRightCorner(n, n) =
        -mass.solve(Eigen::MatrixXd(system.C.view()) + speed * Eigen::MatrixXd(system.G.view()));
    return state;
}

/// Imaginary parts of the eigenvalues; the matrix is overwritten.
Eigen::VectorXd lapack_frequencies(Eigen::MatrixXd matrix, bool vectors) {
    const int n = static_cast<int>(matrix.rows());
    const int length = 66 * n;
    const int columns = vectors ? n : 1;
    Eigen::VectorXd re(n), im(n), work(length);
    Eigen::MatrixXd right(columns, columns);
    int info = 0;
    dgeev_("N", vectors ? "V" : "N", &n, matrix.data(), &n, re.data(), im.data(), nullptr, &n,
           right.data(), &columns, work.data(), &length, &info);
    if (info != 0)
        throw std::runtime_error("dgeev did not converge");
    return im;
}

} // namespace

DenseSolve dense_solve(const model::Rotor &rotor, int order, int refinement, double speed,
                       bool vectors, int repeats) {
    const Eigen::MatrixXd state = state_matrix(rotor, order, refinement, speed);
    DenseSolve result{static_cast<int>(state.rows()), 0, {}};
    Eigen::VectorXd imaginary;
    for (int i = 0; i < repeats; ++i) {
        const double seconds = seconds_of([&] { imaginary = lapack_frequencies(state, vectors); });
        result.seconds = i == 0 ? seconds : std::min(result.seconds, seconds);
    }
    for (const double value : imaginary)
        if (value > 0)
            result.frequencies.push_back(value);
    std::sort(result.frequencies.begin(), result.frequencies.end());
    return result;
}

} // namespace whirl::benchmarks
