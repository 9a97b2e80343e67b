#include "linalg/dense/definite.h"
#include "linalg/dense/products.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

namespace products_test {

using namespace whirl;

// A B, A^T B and A^H B of two by two by hand.
TEST(Products, OfComplexMatrices) {
    const std::complex<double> i(0, 1);
    Eigen::MatrixXcd A(2, 2);
    A << 1, i, 2, 3.0 - i;
    Eigen::MatrixXcd B(2, 1);
    B << i, 2;
    const Eigen::MatrixXcd AB = linalg::times(A, B);
    EXPECT_EQ(AB(0), 3.0 * i);
    EXPECT_EQ(AB(1), 6.0);
    const Eigen::MatrixXcd transposed = linalg::transposed_times(A, B);
    EXPECT_EQ(transposed(0), 4.0 + i);
    EXPECT_EQ(transposed(1), 5.0 - 2.0 * i);
    const Eigen::MatrixXcd adjoint = linalg::adjoint_times(A, B);
    EXPECT_EQ(adjoint(0), 4.0 + i);
    EXPECT_EQ(adjoint(1), 7.0 + 2.0 * i);
}

TEST(Cholesky, OfAPositiveMatrixAlone) {
    Eigen::MatrixXd A(2, 2);
    A << 4, 2, 2, 10;
    const auto L = linalg::cholesky(A);
    ASSERT_TRUE(L);
    EXPECT_EQ((*L)(0, 0), 2);
    EXPECT_EQ((*L)(0, 1), 0);
    EXPECT_EQ((*L)(1, 0), 1);
    EXPECT_EQ((*L)(1, 1), 3);
    A(1, 1) = 0.9;
    EXPECT_FALSE(linalg::cholesky(A));
}

TEST(SymmetricPair, ValuesOfTwoByTwo) {
    Eigen::MatrixXd A(2, 2);
    A << 2, -1, -1, 2;
    Eigen::MatrixXd B = Eigen::MatrixXd::Identity(2, 2);
    B(1, 1) = 2; // 2 l^2 - 6 l + 3 = 0
    const auto values = linalg::symmetric_pair_values(A, B);
    ASSERT_TRUE(values);
    EXPECT_NEAR((*values)(0), (3 - std::sqrt(3.0)) / 2, 1e-15);
    EXPECT_NEAR((*values)(1), (3 + std::sqrt(3.0)) / 2, 2e-15);
    B(1, 1) = 0;
    EXPECT_FALSE(linalg::symmetric_pair_values(A, B));
}

} // namespace products_test
