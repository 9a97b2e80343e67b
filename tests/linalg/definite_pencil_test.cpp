#include "linalg/check.h"
#include "linalg/definite_pencil.h"
#include "linalg/test_matrices.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace {

using namespace whirl;
using linalg::DefinitePencil;
using linalg::RealPair;

void sort_by_modulus(std::vector<double> &values) {
    std::sort(values.begin(), values.end(),
              [](double a, double b) { return std::abs(a) < std::abs(b); });
}

/// All eigenvalues of K + w s S - w^2 M by the dense companion matrix: independent of the pencil's
/// own way.
std::vector<double> companion_values(const Eigen::MatrixXd &K, const Eigen::MatrixXd &M,
                                     const Eigen::MatrixXd &S, double s) {
    const Eigen::Index n = K.rows();
    Eigen::MatrixXd C = Eigen::MatrixXd::Zero(2 * n, 2 * n);
    C.topRightCorner(n, n).setIdentity();
    const Eigen::PartialPivLU<Eigen::MatrixXd> mass(M);
    const Eigen::MatrixXd linear = s * S;
    const Eigen::MatrixXd solved_K = mass.solve(K);
    const Eigen::MatrixXd solved_S = mass.solve(linear);
    C.bottomLeftCorner(n, n) = solved_K;
    C.bottomRightCorner(n, n) = solved_S;
    const Eigen::VectorXcd all = Eigen::EigenSolver<Eigen::MatrixXd>(C, false).eigenvalues();
    std::vector<double> values;
    for (const auto &value : all)
        values.push_back(value.real());
    sort_by_modulus(values);
    return values;
}

TEST(DefinitePencil, OneUnknownHasTheTwoRootsOfItsQuadraticEquation) {
    // 12 + w 3 * 2 - w^2 * 1.5 = 0: w = 2 +- 2 sqrt(3).
    const DefinitePencil pencil(tests::diagonal({12}), tests::diagonal({1.5}),
                                tests::diagonal({2}));
    const std::vector<RealPair> pairs = pencil.smallest(3, 2);
    ASSERT_EQ(pairs.size(), 2U);
    EXPECT_NEAR(pairs[0].value, 2 - 2 * std::sqrt(3.0), 1e-14);
    EXPECT_NEAR(pairs[1].value, 2 + 2 * std::sqrt(3.0), 1e-14);
    EXPECT_EQ(pencil.count_below(3, 2), 1);
    EXPECT_EQ(pencil.count_below(3, 6), 2);
}

/// Stiffness of unit masses between walls by unit springs.
Eigen::MatrixXd chain(int n) {
    Eigen::MatrixXd K = 2 * Eigen::MatrixXd::Identity(n, n);
    K.diagonal(1).setConstant(-1);
    K.diagonal(-1).setConstant(-1);
    return K;
}

/// Modulus of the i-th of its eigenvalues +-w.
double of_chain(int n, std::size_t i) {
    return 2 * std::sin((std::floor(static_cast<double>(i) / 2) + 1) * std::numbers::pi /
                        (2 * (n + 1)));
}

/// Chain of n unit masses between walls by unit springs: w_k = 2 sin(k pi / (2 (n + 1))).
TEST(DefinitePencil, ChainOfMassesOfThreeSizes) {
    for (const int n : {10, 120, 400}) { // dense; iteration in modes; iteration by solves
        const Eigen::MatrixXd K = chain(n);
        const Eigen::MatrixXd I = Eigen::MatrixXd::Identity(n, n);
        const DefinitePencil pencil(tests::matrix_of(K), tests::matrix_of(I),
                                    tests::matrix_of(0 * I));
        const std::vector<RealPair> pairs = pencil.smallest(0, 8);
        ASSERT_GE(pairs.size(), 8U);
        for (std::size_t i = 0; i < 8; ++i) {
            const double exact = of_chain(n, i);
            EXPECT_NEAR(std::abs(pairs[i].value), exact, 1e-12 * exact) << n << " " << i;
        }
        EXPECT_NE(std::signbit(pairs[0].value), std::signbit(pairs[1].value));
    }
}

TEST(DefinitePencil, ResidualAndRoundingBoundTheError) {
    const int n = 60;
    const Eigen::MatrixXd K = tests::random_definite(n, 1);
    const Eigen::MatrixXd M = tests::random_definite(n, 2) / n;
    const Eigen::MatrixXd S = tests::random_symmetric(n, 3);
    const DefinitePencil pencil(tests::matrix_of(K), tests::matrix_of(M), tests::matrix_of(S));
    for (const double s : {-3.0, 0.0, 0.7, 20.0}) {
        const std::vector<double> exact = companion_values(K, M, S, s);
        const std::vector<RealPair> pairs = pencil.smallest(s, 12);
        ASSERT_GE(pairs.size(), 12U);
        for (std::size_t i = 0; i < pairs.size(); ++i) {
            const double w = pairs[i].value;
            const double error = std::abs(w - exact[i]) / std::abs(exact[i]);
            EXPECT_LT(pairs[i].residual, 1e-8); // of w; w itself is off by its square
            // 1e-12: what the nonsymmetric dense comparison leaves.
            if (s != 0) { // at rest +-w change places freely
                EXPECT_LE(error, pairs[i].residual + pairs[i].rounding + 1e-12) << s << " " << i;
            }
            const Eigen::VectorXd x = pairs[i].vector;
            const Eigen::VectorXd r = K * x + w * s * (S * x) - w * w * (M * x);
            EXPECT_LT(r.norm(), 1e-7 * (K * x).norm());
            EXPECT_NEAR(x.dot(K * x) + w * w * x.dot(M * x), 1, 1e-9);
        }
    }
}

TEST(DefinitePencil, CountsWhatADenseSolverFinds) {
    const int n = 25;
    const Eigen::MatrixXd K = tests::random_definite(n, 4);
    const Eigen::MatrixXd M = tests::random_definite(n, 5) / n;
    const Eigen::MatrixXd S = tests::random_symmetric(n, 6);
    const DefinitePencil pencil(tests::matrix_of(K), tests::matrix_of(M), tests::matrix_of(S));
    const std::vector<double> all = companion_values(K, M, S, 2.5);
    for (std::size_t k = 1; k < all.size(); ++k) {
        const double between = (std::abs(all[k - 1]) + std::abs(all[k])) / 2;
        EXPECT_EQ(pencil.count_below(2.5, between), static_cast<int>(k));
    }
}

TEST(DefinitePencil, FindsEveryCopyOfARepeatedEigenvalue) {
    // Five equal oscillators among sixty, at rest: +-1 five times each, then +-2, +-3, ...
    std::vector<double> k;
    for (int i = 0; i < 5; ++i)
        k.push_back(1);
    for (int i = 2; i < 57; ++i)
        k.push_back(i * i);
    const std::vector<double> ones(k.size(), 1.0);
    const std::vector<double> coupling(k.size(), 1.0);
    const DefinitePencil pencil(tests::diagonal(k), tests::diagonal(ones),
                                tests::diagonal(coupling));
    const std::vector<RealPair> rest = pencil.smallest(0, 12);
    ASSERT_GE(rest.size(), 12U);
    for (std::size_t i = 0; i < 10; ++i)
        EXPECT_NEAR(std::abs(rest[i].value), 1, 1e-12) << i;
    EXPECT_NEAR(std::abs(rest[10].value), 2, 1e-12);
    EXPECT_NEAR(std::abs(rest[11].value), 2, 1e-12);
    // Turning splits +-1 into (s +- sqrt(s^2 + 4))/2, still five times each; s = 1.5: -0.5, 2.
    const std::vector<RealPair> turning = pencil.smallest(1.5, 5);
    ASSERT_GE(turning.size(), 5U);
    for (std::size_t i = 0; i < 5; ++i)
        EXPECT_NEAR(turning[i].value, -0.5, 1e-12) << i;
}

TEST(DefinitePencil, NearlyEqualEigenvaluesAreBothThere) {
    std::vector<double> k{1, 1 + 1e-9, 4, 4 + 1e-12};
    for (int i = 3; i < 60; ++i)
        k.push_back(i * i);
    const DefinitePencil pencil(tests::diagonal(k), tests::diagonal(std::vector(k.size(), 1.0)),
                                tests::diagonal(std::vector(k.size(), 0.0)));
    const std::vector<RealPair> pairs = pencil.smallest(0, 8);
    ASSERT_GE(pairs.size(), 8U);
    EXPECT_NEAR(std::abs(pairs[3].value) - std::abs(pairs[0].value), 0.5e-9, 1e-13);
    EXPECT_NEAR(std::abs(pairs[7].value), 2, 1e-11);
}

TEST(DefinitePencil, RefusesMatricesThatAreNotPositiveDefinite) {
    const linalg::Matrix good = tests::diagonal({1, 2});
    const linalg::Matrix bad = tests::diagonal({1, -1});
    testing::internal::CaptureStderr();
    EXPECT_THROW(DefinitePencil(bad, good, good), linalg::SolverError);
    EXPECT_THROW(DefinitePencil(good, bad, good), linalg::SolverError);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

} // namespace
