#include "linalg/check.h"
#include "linalg/quadratic/quadratic_eigen.h"
#include "linalg/test_matrices.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace {

using namespace whirl;
using linalg::ComplexPair;
using linalg::QuadraticMethod;
using linalg::QuadraticResult;
using linalg::solve_quadratic;

/// A single mass: m l^2 + c l + k = 0.
QuadraticResult single_mass(double m, double c, double k) {
    return solve_quadratic(tests::diagonal({m}), tests::diagonal({c}), tests::diagonal({k}),
                           {.wanted = 2});
}

TEST(QuadraticEigen, UnderdampedMassHasItsPairOnce) {
    const QuadraticResult found = single_mass(2, 4, 100); // l = -1 +- 7 i
    ASSERT_EQ(found.pairs.size(), 1U);
    EXPECT_NEAR(std::abs(found.pairs[0].value - std::complex<double>(-1, 7)), 0, 1e-13);
    EXPECT_LT(found.pairs[0].residual, 1e-13);
}

TEST(QuadraticEigen, OverdampedMassHasTwoRealEigenvalues) {
    const QuadraticResult found = single_mass(1, 5, 4); // (l + 1)(l + 4)
    ASSERT_EQ(found.pairs.size(), 2U);
    EXPECT_NEAR(found.pairs[0].value.real(), -1, 1e-14);
    EXPECT_NEAR(found.pairs[1].value.real(), -4, 1e-13);
    EXPECT_EQ(found.pairs[0].value.imag(), 0);
    EXPECT_EQ(found.pairs[1].value.imag(), 0);
}

TEST(QuadraticEigen, MasslessDamperHasOneEigenvalue) {
    const QuadraticResult found = single_mass(0, 5, 20); // the other one is infinite
    ASSERT_EQ(found.pairs.size(), 1U);
    EXPECT_NEAR(found.pairs[0].value.real(), -4, 1e-14);
}

struct System {
    Eigen::MatrixXd M, D, K;
};

/// Gyroscopic, damped and circulatory, of moderate size.
System rotor_like(int n) {
    const Eigen::MatrixXd A = tests::random_symmetric(n, 12);
    Eigen::MatrixXd skew = Eigen::MatrixXd::Zero(n, n);
    skew.triangularView<Eigen::StrictlyUpper>() = A;
    skew -= skew.transpose().eval();
    return {tests::random_definite(n, 10) / n, 0.1 * tests::random_definite(n, 11) / n + skew,
            10 * tests::random_definite(n, 13) + 0.1 * skew};
}

QuadraticResult solve(const System &s, const linalg::QuadraticOptions &options) {
    return solve_quadratic(tests::matrix_of(s.M), tests::matrix_of(s.D), tests::matrix_of(s.K),
                           options);
}

TEST(QuadraticEigen, LeftVectorsSolveTheTransposedProblem) {
    const int n = 30;
    const System s = rotor_like(n);
    const QuadraticResult found =
        solve(s, {.wanted = 6, .shift = 1, .method = QuadraticMethod::toar, .condition = true});
    ASSERT_GE(found.pairs.size(), 6U);
    for (const ComplexPair &pair : found.pairs) {
        ASSERT_EQ(pair.left.size(), n);
        const std::complex<double> l = pair.value;
        const Eigen::MatrixXcd Q = l * l * s.M + l * s.D + s.K;
        EXPECT_LT((Q.transpose() * pair.left).norm(), 1e-11 * Q.norm() * pair.left.norm());
    }
}

TEST(QuadraticEigen, DenseAndArnoldiFindTheSame) {
    const System s = rotor_like(90);
    for (const double shift : {0.0, -3.0}) {
        const QuadraticResult dense =
            solve(s, {.wanted = 10, .shift = shift, .method = QuadraticMethod::dense});
        const QuadraticResult toar =
            solve(s, {.wanted = 10, .shift = shift, .method = QuadraticMethod::toar});
        EXPECT_EQ(dense.method, QuadraticMethod::dense);
        EXPECT_EQ(toar.method, QuadraticMethod::toar);
        ASSERT_GE(toar.pairs.size(), 10U);
        for (std::size_t i = 0; i < 10; ++i) {
            const std::complex<double> l = dense.pairs[i].value;
            EXPECT_LT(std::abs(toar.pairs[i].value - l), 1e-10 * std::abs(l)) << i;
            EXPECT_GE(l.imag(), 0);
            EXPECT_GE(std::abs(l - shift), i == 0 ? 0 : std::abs(dense.pairs[i - 1].value - shift));
        }
    }
}

TEST(QuadraticEigen, OneSolverForSeveralOptionsFindsTheSame) {
    const System s = rotor_like(40);
    linalg::QuadraticSolver solver(s.M.sparseView(), s.D.sparseView(), s.K.sparseView(), 1);
    for (const int wanted : {30, 3, 20}) { // all, TOAR, all again
        const linalg::QuadraticOptions options{.wanted = wanted, .shift = 1};
        const QuadraticResult alone = solve(s, options);
        const QuadraticResult again = solver.solve(options);
        EXPECT_EQ(again.method, wanted == 3 ? QuadraticMethod::toar : QuadraticMethod::dense);
        EXPECT_EQ(again.complete_radius, alone.complete_radius);
        ASSERT_EQ(again.pairs.size(), alone.pairs.size());
        for (std::size_t i = 0; i < alone.pairs.size(); ++i) {
            EXPECT_EQ(again.pairs[i].value, alone.pairs[i].value);
            EXPECT_EQ(again.pairs[i].residual, alone.pairs[i].residual);
        }
    }
}

TEST(QuadraticEigen, ResidualsAndVectorsSatisfyTheEquation) {
    const System s = rotor_like(90);
    const QuadraticResult found = solve(s, {.wanted = 10});
    for (const ComplexPair &pair : found.pairs) {
        const std::complex<double> l = pair.value;
        const Eigen::VectorXcd Kx = s.K * pair.vector;
        const Eigen::VectorXcd r = l * l * (s.M * pair.vector) + l * (s.D * pair.vector) + Kx;
        EXPECT_LT(r.norm(), 1e-9 * Kx.norm());
        EXPECT_LT(pair.residual, 1e-10);
        EXPECT_NEAR(pair.vector.cwiseAbs().maxCoeff(), 1, 1e-14);
    }
    EXPECT_GE(found.complete_radius, std::abs(found.pairs[9].value));
}

TEST(QuadraticEigen, FewerThanAskedForMeansThatAllAreThere) {
    const QuadraticResult found = solve(rotor_like(30), {.wanted = 60});
    EXPECT_EQ(found.complete_radius, std::numeric_limits<double>::infinity());
    int count = 0;
    for (const ComplexPair &pair : found.pairs)
        count += pair.value.imag() > 0 ? 2 : 1;
    EXPECT_EQ(count, 60);
}

/// Eigenvalue of the smaller modulus of l^2 + K for a K of two by two, Im l > 0.
double slower_whirl(const Eigen::Matrix2d &K) {
    const double half = K.trace() / 2;
    return std::sqrt(half - std::sqrt(half * half - K.determinant()));
}

// Circulatory coupling makes right and left vectors nearly orthogonal: entries changed by a share
// e each, all so that the changes add up, move the eigenvalue by e times its condition. Of the
// right vector alone nothing of that is seen.
TEST(QuadraticEigen, RoundingIsWhatChangedEntriesDo) {
    const double root = std::sqrt(0.5);
    Eigen::Matrix2d turn;
    turn << root, -root, root, root;
    Eigen::Matrix2d triangle;
    triangle << 1, 30, 0, 1.2;
    const Eigen::Matrix2d K = turn * triangle * turn.transpose();
    const Eigen::Vector2d right = turn.col(0);
    const Eigen::Vector2d left = turn * Eigen::Vector2d(0.2, -30);
    const auto solved = [&](bool condition) {
        linalg::QuadraticOptions options;
        options.wanted = 2;
        options.condition = condition;
        const Eigen::SparseMatrix<double> one = Eigen::Matrix2d::Identity().sparseView();
        const Eigen::SparseMatrix<double> none(2, 2);
        return solve_quadratic(one, none, K.sparseView(), options);
    };
    const ComplexPair pair = solved(true).pairs.at(0);
    ASSERT_NEAR(pair.value.imag(), 1, 1e-9);
    constexpr double share = 1e-9; // small enough for the first order, far above rounding
    const Eigen::Matrix2d signs = (left * right.transpose()).cwiseSign();
    const Eigen::Matrix2d changed = K + share * K.cwiseAbs().cwiseProduct(signs);
    const double moved = std::abs(slower_whirl(changed) - 1);
    const double stated = pair.rounding * share / std::numeric_limits<double>::epsilon();
    EXPECT_LT(moved, 1.01 * stated);
    EXPECT_GT(moved, 0.4 * stated); // the entries of M count as much as those of K at least
    EXPECT_LT(solved(false).pairs.at(0).rounding, 0.1 * pair.rounding);
}

TEST(QuadraticEigen, SingularShiftIsAnException) {
    const linalg::Matrix I = tests::diagonal({1, 1, 1});
    const linalg::Matrix zero = tests::diagonal({0, 0, 0});
    const linalg::Matrix K = tests::diagonal({0, 1, 4}); // free in one unknown: l = 0 twice
    testing::internal::CaptureStderr();
    EXPECT_THROW((void)solve_quadratic(I, zero, K, {.wanted = 2}), linalg::SolverError);
    EXPECT_THROW((void)solve_quadratic(I, zero, K, {.wanted = 2, .method = QuadraticMethod::toar}),
                 linalg::SolverError);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    // Beside the singular point it works: 0 twice, +-i, +-2i.
    const QuadraticResult found = solve_quadratic(I, zero, K, {.wanted = 4, .shift = 0.5});
    EXPECT_NEAR(std::abs(found.pairs.back().value - std::complex<double>(0, 2)), 0, 1e-12);
}

TEST(QuadraticEigen, HugeSpringsDoNotSpoilTheLowEigenvalues) {
    // Two unit masses, one held by 1e16 N/m, between them 1 N/m: l^2 = -1 to 1e-16.
    Eigen::MatrixXd K(2, 2);
    K << 1e16, -1, -1, 1;
    const linalg::Matrix I = tests::diagonal({1, 1});
    const QuadraticResult found =
        solve_quadratic(I, tests::diagonal({0, 0}), tests::matrix_of(K), {.wanted = 1});
    EXPECT_NEAR(std::abs(found.pairs[0].value - std::complex<double>(0, 1)), 0, 1e-14);
    EXPECT_LT(found.pairs[0].residual, 1e-14);
}

} // namespace
