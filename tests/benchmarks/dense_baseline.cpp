#include "benchmarks/dense_baseline.h"
#include "assembly/system.h"
#include "benchmarks/stopwatch.h"
#include "forced/forced_motion.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <complex>
#include <stdexcept>

extern "C" void dgeev_(const char *left, const char *right, const int *n, double *a, const int *lda,
                       double *re, double *im, double *vl, const int *ldvl, double *vr,
                       const int *ldvr, double *work, const int *lwork, int *info);
extern "C" void zgesv_(const int *n, const int *columns, std::complex<double> *a, const int *lda,
                       int *pivots, std::complex<double> *b, const int *ldb, int *info);

namespace whirl::benchmarks {

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

Eigen::VectorXd dense_frequencies(Eigen::MatrixXd matrix, bool vectors) {
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

DenseSolve dense_solve(const model::Rotor &rotor, int order, int refinement, double speed,
                       bool vectors, int repeats) {
    const Eigen::MatrixXd state = state_matrix(rotor, order, refinement, speed);
    DenseSolve result{static_cast<int>(state.rows()), 0, {}};
    Eigen::VectorXd imaginary;
    for (int i = 0; i < repeats; ++i) {
        const double seconds = seconds_of([&] { imaginary = dense_frequencies(state, vectors); });
        result.seconds = i == 0 ? seconds : std::min(result.seconds, seconds);
    }
    for (const double value : imaginary)
        if (value > 0)
            result.frequencies.push_back(value);
    std::sort(result.frequencies.begin(), result.frequencies.end());
    return result;
}

DenseHarmonic dense_harmonic(const model::Rotor &rotor, int order, double speed) {
    const assembly::Discretization discretization(rotor, order);
    const assembly::FixedSystem system = assembly::assemble_fixed(discretization, speed);
    const auto dense = [](const linalg::Matrix &matrix) { return Eigen::MatrixXd(matrix.view()); };
    const Eigen::MatrixXd stiff =
        dense(system.K) + speed * dense(system.Kc) - speed * speed * dense(system.M);
    const Eigen::MatrixXd lossy = speed * (dense(system.C) + speed * dense(system.G));
    DenseHarmonic problem{Eigen::MatrixXcd(stiff.rows(), stiff.cols()),
                          Eigen::VectorXcd(stiff.rows())};
    problem.A.real() = stiff;
    problem.A.imag() = lossy;
    const Eigen::VectorXcd loads = speed * speed * forced::imbalance_loads(discretization);
    for (Eigen::Index i = 0; i < loads.size(); ++i) {
        problem.f[2 * i] = loads[i];
        problem.f[2 * i + 1] = -forced::imaginary_unit * loads[i];
    }
    return problem;
}

Eigen::VectorXcd dense_motion(DenseHarmonic problem) {
    const int n = static_cast<int>(problem.A.rows());
    const int columns = 1;
    std::vector<int> pivots(static_cast<std::size_t>(n));
    int info = 0;
    zgesv_(&n, &columns, problem.A.data(), &n, pivots.data(), problem.f.data(), &n, &info);
    if (info != 0)
        throw std::runtime_error("zgesv: the matrix is singular");
    return problem.f;
}

} // namespace whirl::benchmarks
