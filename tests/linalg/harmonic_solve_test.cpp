#include "linalg/harmonic_solve.h"

#include "linalg/check.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace {

using namespace whirl::linalg;

Matrix sparse(const Eigen::MatrixXd &A) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < A.rows(); ++i)
        for (int j = 0; j < A.cols(); ++j)
            if (A(i, j) != 0)
                entries.emplace_back(i, j, A(i, j));
    return Matrix::from_entries(static_cast<int>(A.rows()), entries);
}

/// Matrices without any symmetry that an error could hide behind, the same at every run.
Eigen::MatrixXd numbers(int n, double seed) {
    Eigen::MatrixXd A(n, n);
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
            A(i, j) = std::sin(seed * (1 + i) + 2.3 * j * j + seed);
    return A;
}

TEST(HarmonicSolve, agrees_with_a_dense_complex_solution_at_every_speed) {
    const int n = 7;
    const Eigen::MatrixXd M = numbers(n, 0.3);
    const Eigen::MatrixXd C = numbers(n, 0.7);
    Eigen::MatrixXd G = numbers(n, 1.1);
    G.row(2).setZero();
    const Eigen::MatrixXd K = numbers(n, 1.9) + 8 * Eigen::MatrixXd::Identity(n, n);
    const Eigen::MatrixXd Kc = numbers(n, 2.9);
    const Matrix m = sparse(M);
    const Matrix c = sparse(C);
    const Matrix g = sparse(G);
    const Matrix k = sparse(K);
    const Matrix kc = sparse(Kc);
    HarmonicSolver solver({&m, &c, &g, &k, &kc});
    EXPECT_EQ(solver.size(), n);
    Eigen::MatrixXcd f(n, 2);
    f.real() = numbers(n, 4.1).leftCols(2);
    f.imag() = numbers(n, 5.3).leftCols(2);
    const std::complex<double> i(0, 1);
    for (const double s : {0.0, 0.4, -1.3, 2.5}) {
        const Eigen::MatrixXcd A = (K + s * Kc - s * s * M) + i * s * (C + s * G);
        const HarmonicSolution found = solver.solve(s, f);
        const Eigen::MatrixXcd expected = A.partialPivLu().solve(f);
        EXPECT_LT((found.displacements - expected).norm(), 1e-12 * expected.norm()) << s;
        EXPECT_LT(found.residual, 1e-14);
        EXPECT_LT(found.rounding, 1e-12);
    }
}

TEST(HarmonicSolve, singular_matrix_is_refused_or_seen_in_the_rounding) {
    const Matrix M = sparse(Eigen::MatrixXd::Identity(2, 2));
    Eigen::MatrixXd stiffness(2, 2);
    stiffness << 2, -1, -1, 2; // eigenvalues 1 and 3
    const Matrix K = sparse(stiffness);
    HarmonicSolver solver({&M, nullptr, nullptr, &K, nullptr});
    const Eigen::MatrixXcd f = Eigen::MatrixXcd::Identity(2, 1);
    EXPECT_THROW((void)solver.solve(1.0, f), SolverError);
    EXPECT_GT(solver.solve(std::sqrt(3.0), f).rounding, 1e-3);
    // The solver is good for other speeds afterwards.
    EXPECT_LT(solver.solve(2.0, f).rounding, 1e-14);
}

} // namespace
