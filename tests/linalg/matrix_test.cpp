#include "linalg/check.h"
#include "linalg/test_matrices.h"
#include "process/processes.h"

#include <gtest/gtest.h>

#include <utility>

namespace {

using namespace whirl;
using linalg::Matrix;

TEST(Matrix, SumsEntriesAtEqualPlaces) {
    const Matrix A = Matrix::from_entries(3, {{0, 0, 1.0}, {0, 2, 4.0}, {0, 0, 2.5}, {2, 1, -1.0}});
    Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(3, 3);
    expected(0, 0) = 3.5;
    expected(0, 2) = 4;
    expected(2, 1) = -1;
    EXPECT_EQ(A.size(), 3);
    EXPECT_EQ(Eigen::MatrixXd(A.view()), expected);
}

TEST(Matrix, StoresItsWholeDiagonal) {
    const Matrix A = Matrix::from_entries(2, {});
    EXPECT_EQ(A.view().nonZeros(), 2);
    EXPECT_EQ(Eigen::MatrixXd(A.view()).norm(), 0);
}

TEST(Matrix, SumOfDifferentPatterns) {
    const Matrix A = Matrix::from_entries(2, {{0, 1, 2.0}});
    const Matrix B = Matrix::from_entries(2, {{1, 0, 5.0}, {0, 1, 1.0}});
    Eigen::MatrixXd expected(2, 2);
    expected << 0, 3, 10, 0;
    EXPECT_EQ(Eigen::MatrixXd(Matrix::sum(0.5, A, 2, B).view()), expected);
    EXPECT_EQ(Eigen::MatrixXd(A.view())(0, 1), 2); // the terms stay as they were
}

TEST(Matrix, MovedFromIsEmptyAndCanBeUsedAgain) {
    Matrix A = Matrix::from_entries(2, {{0, 0, 1.0}});
    const Matrix B = std::move(A);
    EXPECT_EQ(B.size(), 2);
    // NOLINTNEXTLINE(bugprone-use-after-move): this is what is tested
    EXPECT_EQ(A.handle(), nullptr);
    EXPECT_EQ(A.size(), 0);
    A = Matrix::from_entries(3, {{1, 1, 1.0}});
    EXPECT_EQ(A.size(), 3);
}

TEST(Matrix, ErrorsOfPetscThrowAndPrintNothing) {
    const Matrix A = Matrix::from_entries(2, {{0, 0, 1.0}});
    const Matrix B = Matrix::from_entries(3, {{0, 0, 1.0}});
    testing::internal::CaptureStderr();
    testing::internal::CaptureStdout();
    EXPECT_THROW((void)Matrix::sum(1, A, 1, B), linalg::SolverError);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

TEST(Check, NamesTheCodeAndThePlace) {
    EXPECT_NO_THROW(linalg::check(0));
    try {
        linalg::check(63);
        FAIL() << "no exception";
    } catch (const linalg::SolverError &error) {
        const std::string text = error.what();
        EXPECT_NE(text.find("63"), std::string::npos);
        EXPECT_NE(text.find("matrix_test.cpp"), std::string::npos);
    }
}

TEST(Session, OfASingleProcess) {
    EXPECT_EQ(process::process_count(), 1);
    EXPECT_EQ(process::process_rank(), 0);
    const std::vector<char> bytes{'a', 'b'};
    EXPECT_EQ(process::gather(bytes), std::vector<std::vector<char>>{bytes});
    std::vector<char> same = bytes;
    process::broadcast(same);
    EXPECT_EQ(same, bytes);
}

} // namespace
