// Factors of sparse matrices against dense ones.

#include "linalg/sparse_factor.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include <algorithm>
#include <complex>
#include <random>

namespace whirl::linalg {
namespace {

/// A chain with couplings to neighbours, without symmetry, in an order that hides it.
Eigen::MatrixXd chain(int size, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> entry(-1, 1);
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(size, size);
    const auto place = [size](int i) { return (7 * i) % size; };
    for (int i = 0; i < size; ++i)
        for (int k = std::max(0, i - 2); k < std::min(size, i + 3); ++k)
            A(place(i), place(k)) = entry(random);
    return A;
}

Eigen::SparseMatrix<double> sparse(const Eigen::MatrixXd &A) { return A.sparseView(); }

TEST(SparseFactor, SignOfTheDeterminantIsThatOfTheDenseOne) {
    int negative = 0;
    for (unsigned seed = 0; seed < 40; ++seed) {
        const Eigen::MatrixXd A = chain(4 + static_cast<int>(seed) % 9, seed);
        SparseFactor<double> factors;
        if (A.rows() % 7 == 0) // the order of chain() needs numbers without a common divisor
            continue;
        ASSERT_TRUE(factors.factorize(sparse(A)));
        EXPECT_EQ(factors.negative_determinant(), A.determinant() < 0) << "seed " << seed;
        negative += A.determinant() < 0 ? 1 : 0;
    }
    EXPECT_GT(negative, 5);
    EXPECT_LT(negative, 35);
}

TEST(SparseFactor, SignOfTheDeterminantOfExchangedRowsChanges) {
    Eigen::MatrixXd A = Eigen::MatrixXd::Identity(6, 6);
    for (int i = 0; i + 1 < 6; ++i) {
        A.row(i).swap(A.row(i + 1)); // one exchange more each time
        SparseFactor<double> factors;
        ASSERT_TRUE(factors.factorize(sparse(A)));
        EXPECT_EQ(factors.negative_determinant(), i % 2 == 0);
    }
}

TEST(SparseFactor, SolvesWithTheMatrixAndItsAdjoint) {
    const Eigen::MatrixXcd A = chain(11, 1) + std::complex<double>(0, 1) * chain(11, 2);
    SparseFactor<std::complex<double>> factors;
    ASSERT_TRUE(factors.factorize(A.sparseView()));
    const Eigen::VectorXcd b = Eigen::VectorXcd::LinSpaced(11, {1, -1}, {2, 3});
    EXPECT_LT((A * factors.solution(b) - b).norm(), 1e-12 * b.norm());
    EXPECT_LT((A.adjoint() * factors.adjoint_solution(b) - b).norm(), 1e-12 * b.norm());
}

TEST(SparseFactor, SingularMatricesHaveNone) {
    Eigen::MatrixXd A = chain(5, 3);
    A.col(2).setZero();
    SparseFactor<double> factors;
    EXPECT_FALSE(factors.factorize(sparse(A)));
    EXPECT_FALSE(factors.factorize(sparse(Eigen::MatrixXd::Ones(3, 3))));
}

} // namespace
} // namespace whirl::linalg
