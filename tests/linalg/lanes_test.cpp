// Small matrices in vector instructions against Eigen's.

#include "linalg/check.h"
#include "linalg/lanes/directions.h"
#include "linalg/lanes/row_products.h"
#include "linalg/lanes/small_products.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <random>
#include <vector>

namespace {

using namespace whirl::linalg;
using Complex = std::complex<double>;

Eigen::MatrixXcd random_complex(int rows, int columns, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> entry(-1, 1);
    return Eigen::MatrixXcd::NullaryExpr(rows, columns, [&] {
        const double re = entry(random);
        return Complex(re, entry(random));
    });
}

Eigen::MatrixXd random_real(int rows, int columns, unsigned seed) {
    return random_complex(rows, columns, seed).real();
}

constexpr std::array sizes{1, 3, 4, 6, 13, 16, 31, 35}; // whole vectors of a machine, and not

TEST(SmallProducts, AreThoseOfEigen) {
    for (const int rows : sizes)
        for (const int columns : {1, 5, 14}) {
            const Eigen::MatrixXd A = random_real(rows, columns, 1);
            const Eigen::VectorXd x = random_real(columns, 1, 2);
            const Eigen::Index whole = whole_vectors(rows);
            EXPECT_EQ(whole % 4, 0);
            Eigen::VectorXd out = Eigen::VectorXd::Ones(whole);
            Eigen::VectorXd expected = Eigen::VectorXd::Zero(whole); // zero beyond the rows
            expected.head(rows) = A * x;
            const RealProduct product(A);
            product(x.data(), out.data());
            EXPECT_LT((out - expected).norm(), 1e-14 * columns);
        }
}

TEST(RowProducts, AreThoseOfEigen) {
    for (const int rows : {1, 5, 12})
        for (const int columns : sizes) {
            const Rows A = random_real(rows, 7, 3);
            const Rows B = random_real(7, columns, 4);
            Rows out = Rows::Ones(rows, columns);
            add_product(A, B, out);
            EXPECT_LT((out - Rows::Ones(rows, columns) - A * B).norm(), 1e-13);
            set_product(A, B, out);
            EXPECT_LT((out - A * B).norm(), 1e-13);
        }
}

TEST(RowProducts, SolveBesideIsTheSolution) {
    for (const int size : sizes) {
        const Eigen::MatrixXd A = random_real(size, size, 5);
        const Eigen::MatrixXd B = random_real(size, 9, 6);
        Rows both(size, size + 9);
        both << A, B;
        solve_beside(both);
        const Eigen::MatrixXd X = both.rightCols(9);
        EXPECT_LT((A * X - B).norm(), 1e-13 * A.norm() * X.norm());
    }
    Rows singular = Rows::Ones(3, 5);
    EXPECT_THROW(solve_beside(singular), SolverError);
}

TEST(RowProducts, SolverSolvesAllRightSides) {
    for (const int size : sizes)
        for (const int columns : {4, 12, 44}) {
            const Eigen::MatrixXcd A = random_complex(size, size, 7);
            const Eigen::MatrixXcd B = random_complex(size, columns, 8);
            Rows re = B.real();
            Rows im = B.imag();
            RowSolver(A).solve(re, im);
            const Eigen::MatrixXcd X = re.cast<Complex>() + Complex(0, 1) * im.cast<Complex>();
            EXPECT_LT((A * X - B).norm(), 1e-13 * A.norm() * X.norm());
        }
}

TEST(Directions, AreThoseOfTheLibraryToTheLastPlaces) {
    std::mt19937 random(5);
    for (const double range : {0.8, 10.0, 1e4, 9.9e5, 1e12}) {
        std::uniform_real_distribution<double> angle(-range, range);
        std::vector<double> angles;
        for (int i = 0; i < 1003; ++i) // the last ones do not fill a vector
            angles.push_back(angle(random));
        for (const int k : {1, 2, 3, 1001}) // next to multiples of a quarter turn
            angles.push_back(k * std::acos(0.0));
        angles.push_back(0);
        std::vector<double> cosines(angles.size());
        std::vector<double> sines(angles.size());
        set_directions(angles.data(), static_cast<int>(angles.size()), cosines.data(),
                       sines.data());
        constexpr double places = 3 * std::numeric_limits<double>::epsilon() / 2;
        for (std::size_t i = 0; i < angles.size(); ++i) {
            EXPECT_NEAR(cosines[i], std::cos(angles[i]), places * std::abs(std::cos(angles[i])))
                << angles[i];
            EXPECT_NEAR(sines[i], std::sin(angles[i]), places * std::abs(std::sin(angles[i])))
                << angles[i];
        }
    }
}

} // namespace
