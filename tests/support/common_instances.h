#pragma once

// Comparisons, random numbers, lists and small matrices as most tests use them: see instances.h.

#include "linalg/matrix.h"
#include "model/rotor.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include <algorithm>
#include <complex>
#include <cstddef>
#include <initializer_list>
#include <random>
#include <string>
#include <vector>

namespace whirl::tests::instances {

inline void compared(std::size_t count, unsigned few, int whole, long index, double number,
                     bool yes, const std::string &text) {
    EXPECT_EQ(count, few);
    EXPECT_EQ(count, count);
    EXPECT_EQ(whole, whole);
    EXPECT_EQ(index, whole);
    EXPECT_EQ(number, whole);
    EXPECT_EQ(number, number);
    EXPECT_EQ(yes, yes);
    EXPECT_EQ(text, text);
    EXPECT_EQ(text, "text");
    EXPECT_NE(text, "text");
    EXPECT_NE(text.find("text"), std::string::npos);
    EXPECT_LT(number, number);
    EXPECT_LE(number, number);
    EXPECT_GT(number, number);
    EXPECT_GE(number, number);
    EXPECT_LT(number, whole);
    EXPECT_GT(number, whole);
    EXPECT_GE(count, few);
    EXPECT_GT(count, few);
    EXPECT_LT(count, few);
    EXPECT_GT(whole, whole);
    EXPECT_GE(whole, whole);
    EXPECT_NEAR(number, number, number);
    EXPECT_DOUBLE_EQ(number, number);
    EXPECT_TRUE(yes) << text << number << whole << count << "text";
    testing::internal::SuiteApiResolver<testing::Test>::GetSetUpCaseOrSuite("", 0);
    testing::internal::SuiteApiResolver<testing::Test>::GetTearDownCaseOrSuite("", 0);
}

inline double drawn(std::mt19937 &draw, std::mt19937_64 &wide) {
    std::uniform_real_distribution<double> number(0, 1);
    std::normal_distribution<double> normal(0, 1);
    std::uniform_int_distribution<int> whole(0, 1);
    return number(draw) + number(wide) + normal(draw) + whole(draw);
}

inline std::vector<std::string> listed(std::vector<std::string> texts, const std::string &text,
                                       std::vector<std::complex<double>> values,
                                       std::vector<double> numbers,
                                       std::initializer_list<double> list, model::Rotor rotor) {
    std::sort(texts.begin(), texts.end());
    texts.push_back(text);
    texts.insert(texts.end(), texts.begin(), texts.end());
    values.push_back(std::complex<double>(numbers.front()));
    values.emplace_back(numbers.front(), 0.0);
    numbers = list;
    numbers.emplace_back(values.front().real());
    numbers.insert(numbers.end(), numbers.begin(), numbers.end());
    rotor.discs.push_back(model::Disc());
    rotor.bearings.push_back(model::Bearing());
    rotor.discs = {model::Disc()};
    rotor.bearings = {model::Bearing()};
    return texts;
}

inline Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd &A, const linalg::Matrix &sparse) {
    const Eigen::MatrixXd B = Eigen::MatrixXd(sparse.view()) + 2.0 * A;
    const Eigen::MatrixXd C = Eigen::MatrixXd::Identity(4, 4) - A * B.transpose();
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(2 * A.rows(), 2 * A.rows());
    out.block(0, 0, 4, 4) = B;
    out.topRightCorner(4, 4).setIdentity();
    out.bottomLeftCorner(4, 4) = -A.partialPivLu().solve(C);
    const Eigen::EigenSolver<Eigen::MatrixXd> solver(out, (A - B).cwiseAbs().maxCoeff() > 1);
    return solver.eigenvalues() * (B - C).norm() + out.eigenvalues();
}

} // namespace whirl::tests::instances
