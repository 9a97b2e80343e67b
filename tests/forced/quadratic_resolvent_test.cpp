// Sums over the poles against a solution of the equations at each place.

#include "forced/quadratic_resolvent.h"
#include "support/random.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>

namespace {

using namespace whirl;
using forced::QuadraticResolvent;
using forced::QuadraticTerms;

/// Largest difference of the numbers and of their slopes from those of LU decompositions, relative.
/// @param b  right sides, a column each
void expect_solutions(const QuadraticTerms &terms, const Eigen::MatrixXcd &b,
                      const Eigen::MatrixXd &rows, double tolerance, bool all_poles) {
    const QuadraticResolvent resolvent(terms, b, rows, 0, 3, all_poles);
    const Eigen::MatrixXcd read = rows.cast<std::complex<double>>();
    for (const double s : {0.01, 0.4, 0.97, 1.0, 1.6, 2.9}) {
        const Eigen::PartialPivLU<Eigen::MatrixXcd> P(terms.at(s));
        const Eigen::MatrixXcd u = P.solve(b);
        const Eigen::MatrixXcd change = terms.P1 + (2 * s) * terms.P2;
        const Eigen::MatrixXcd forces = change * u;
        const Eigen::MatrixXcd slope = P.solve(forces);
        const Eigen::MatrixXcd y = read * u;
        const Eigen::MatrixXcd y_slope = read * slope;
        const auto found = resolvent.at(s, 0, rows.rows());
        ASSERT_EQ(found.y.cols(), b.cols());
        EXPECT_LE((found.y - y).norm(), tolerance * y.norm()) << s;
        EXPECT_LE((found.slope + y_slope).norm(), tolerance * y_slope.norm()) << s;
        const auto last = resolvent.at(s, rows.rows() - 1, 1);
        EXPECT_LE((last.y.row(0) - found.y.row(rows.rows() - 1)).norm(), tolerance * found.y.norm())
            << s;
    }
}

TEST(QuadraticResolvent, SumsOverThePolesSolveTheEquations) {
    tests::Random random(7);
    for (int scene = 0; scene < 20; ++scene) {
        constexpr int n = 9;
        const auto matrix = [&](double size) {
            Eigen::MatrixXcd A(n, n);
            for (Eigen::Index i = 0; i < A.size(); ++i)
                A(i) = size * std::complex<double>(random(-1, 1), random(-1, 1));
            return A;
        };
        QuadraticTerms terms{matrix(0.1), matrix(0.1), -Eigen::MatrixXcd::Identity(n, n)};
        for (int i = 0; i < n; ++i)
            terms.P0(i, i) += 0.3 * (i + 1);
        // Poles some 0.05 from the real speeds, all simple: rounding over that distance.
        expect_solutions(terms, matrix(1).leftCols(3), matrix(1).real().topRows(4), 1e-9, true);
        expect_solutions(terms, matrix(1).leftCols(2), matrix(1).real().topRows(4), 1e-9, false);
    }
}

TEST(QuadraticResolvent, PolesThatCoincideWithOneVector) {
    // Two equal oscillators, one of which drives the other: their poles are of one vector, and the
    // terms of a sum over them are infinite.
    constexpr std::complex<double> i(0, 1);
    QuadraticTerms terms{Eigen::MatrixXcd::Identity(2, 2),
                         0.02 * i * Eigen::MatrixXcd::Identity(2, 2),
                         -Eigen::MatrixXcd::Identity(2, 2)};
    terms.P0(0, 1) = 0.5;
    expect_solutions(terms, Eigen::MatrixXcd::Ones(2, 1), Eigen::MatrixXd::Identity(2, 2), 1e-10,
                     true);
    expect_solutions(terms, Eigen::MatrixXcd::Ones(2, 1), Eigen::MatrixXd::Identity(2, 2), 1e-10,
                     false);
}

/// Of many poles far away those that are felt: the numbers are as exact, of few columns.
TEST(QuadraticResolvent, FarPolesAreTakenTogether) {
    constexpr int n = 60;
    tests::Random random(9);
    QuadraticTerms terms{Eigen::MatrixXcd::Zero(n, n), Eigen::MatrixXcd::Zero(n, n),
                         -Eigen::MatrixXcd::Identity(n, n)};
    for (int k = 0; k < n; ++k) {
        terms.P0(k, k) = std::pow(0.7 * (k + 1), 4); // poles at 0.5, 2, 4.4, ... 1764
        terms.P1(k, k) = std::complex<double>(0, 0.02 * (k + 1));
        terms.P0(k, (k + 1) % n) = 0.1 * random(-1, 1);
    }
    const Eigen::MatrixXcd b = Eigen::MatrixXcd::Ones(n, 1);
    const Eigen::MatrixXd rows = Eigen::MatrixXd::Identity(n, n).topRows(3);
    expect_solutions(terms, b, rows, 1e-10, false);
    const std::size_t felt = QuadraticResolvent(terms, b, rows, 0, 3, false).poles().size();
    EXPECT_LE(felt, 48U); // of 120
    EXPECT_GE(felt, 4U);
}

} // namespace
