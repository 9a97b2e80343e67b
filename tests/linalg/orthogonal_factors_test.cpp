// Orthogonal factors of matrices from well to hardly conditioned, and singular ones: what they are
// defined by.

#include "linalg/check.h"
#include "linalg/dense/orthogonal_factors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace orthogonal_factors_test {

using namespace whirl;

/// Columns of sizes from 1 down to `least`, mixed by a matrix without a pattern.
Eigen::MatrixXd matrix(Eigen::Index rows, Eigen::Index columns, double least) {
    Eigen::MatrixXd out(rows, columns);
    for (Eigen::Index i = 0; i < rows; ++i)
        for (Eigen::Index j = 0; j < columns; ++j)
            out(i, j) = std::sin(1.7 * static_cast<double>(i * columns + j) +
                                 0.3 * static_cast<double>(i * i)) *
                        std::pow(least, static_cast<double>(j) / static_cast<double>(columns - 1));
    return out;
}

TEST(OrthogonalFactors, AreOrthonormalAndTriangularWhateverTheCondition) {
    for (const double least : {1.0, 1e-5, 1e-12, 1e-40})
        for (const Eigen::Index columns : {7, 20}) {
            const Eigen::MatrixXd A = matrix(20, columns, least);
            const linalg::OrthogonalFactors found = linalg::orthogonal_factors(A);
            const Eigen::MatrixXd Q = found.Q;
            const Eigen::MatrixXd unit = Eigen::MatrixXd::Identity(columns, columns);
            EXPECT_LT((Q.transpose() * Q - unit).norm(), 1e-13) << least;
            EXPECT_EQ(found.R.triangularView<Eigen::StrictlyLower>().toDenseMatrix().norm(), 0.0);
            EXPECT_GE(found.R.diagonal().minCoeff(), 0.0) << least;
            // Each column to its own rounding: small ones stay beside large ones.
            for (Eigen::Index j = 0; j < columns; ++j)
                EXPECT_LT((Q * found.R.col(j) - A.col(j)).norm(), 1e-13 * A.col(j).norm())
                    << least << ' ' << j;
        }
}

TEST(OrthogonalFactors, SayThatAnEntryIsNotFinite) {
    Eigen::MatrixXd A = matrix(5, 5, 1);
    A(2, 3) = std::numeric_limits<double>::infinity();
    EXPECT_THROW((void)linalg::orthogonal_factors(A), linalg::SolverError);
}

} // namespace orthogonal_factors_test
