#include "linalg/dense/least_squares.h"

#include <gtest/gtest.h>

#include <complex>
#include <limits>

namespace whirl::linalg {

// A line through points of which none lies on it: the normal equations by hand.
TEST(LeastSquares, FitsALine) {
    Eigen::MatrixXd A(4, 2);
    A << 1, 0, 1, 1, 1, 2, 1, 3;
    const Eigen::VectorXd x = least_squares(A, Eigen::Vector4d(1, 3, 2, 5));
    ASSERT_EQ(x.size(), 2);
    EXPECT_NEAR(x(0), 1.1, 1e-14);
    EXPECT_NEAR(x(1), 1.1, 1e-14);
}

TEST(LeastSquares, TakesTheShortestOfMany) {
    Eigen::MatrixXd A(2, 2); // of rank one, and b not in its range
    A << 1, 1, 1, 1;
    const Eigen::VectorXd x = least_squares(A, Eigen::Vector2d(3, 5));
    EXPECT_NEAR(x(0), 2, 1e-14);
    EXPECT_NEAR(x(1), 2, 1e-14);
}

TEST(LeastSquares, ComplexColumns) {
    const std::complex<double> i(0, 1);
    Eigen::MatrixXcd A(3, 2);
    A << 1, i, 2.0 * i, 1, 1.0 - i, 3;
    Eigen::MatrixXcd X(2, 2);
    X << 1.0 + i, 2, -i, 4.0 - 2.0 * i;
    const Eigen::MatrixXcd B = A * X;
    const Eigen::MatrixXcd found = least_squares(A, B);
    ASSERT_EQ(found.rows(), 2);
    EXPECT_LT((found - X).norm(), 1e-14 * X.norm());
}

TEST(LeastSquares, OfWhatIsNoNumberIsNone) {
    const Eigen::MatrixXd A =
        Eigen::MatrixXd::Constant(2, 2, std::numeric_limits<double>::quiet_NaN());
    EXPECT_TRUE(least_squares(A, Eigen::Vector2d(1, 2)).hasNaN());
}

} // namespace whirl::linalg
