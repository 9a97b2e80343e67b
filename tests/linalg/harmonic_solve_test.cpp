#include "linalg/harmonic_solve.h"

#include "linalg/check.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace {

using namespace whirl::linalg;

Matrix sparse(const Eigen::MatrixXd &A) {
    std::vector<Eigen::Triplet<double>> entries;
    for (int i = 0; i < A.rows(); ++i)
        for (int j = 0; j < A.cols(); ++j)
            if (A(i, j) != 0)
                entries.emplace_back(i, j, A(i, j));
    return Matrix::from_entries(static_cast<int>(A.rows()), entries);
}

/// Matrices without any symmetry that an error could hide behind, the same at every run.
Eigen::MatrixXd numbers(int n, double seed) {
    Eigen::MatrixXd A(n, n);
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
            A(i, j) = std::sin(seed * (1 + i) + 2.3 * j * j + seed);
    return A;
}

/// K + spin Kc - w^2 M + i w (C + spin G), all of them full.
struct FullTerms {
    Eigen::MatrixXd M, C, G, K, Kc;

    explicit FullTerms(int n)
        : M(numbers(n, 0.3)), C(numbers(n, 0.7)), G(numbers(n, 1.1)),
          K(numbers(n, 1.9) + 8 * Eigen::MatrixXd::Identity(n, n)), Kc(numbers(n, 2.9)) {}

    [[nodiscard]] HarmonicTerms terms() const {
        return {sparse(M), sparse(C), sparse(G), sparse(K), sparse(Kc)};
    }
    [[nodiscard]] Eigen::MatrixXcd at(double spin, double w,
                                      const HarmonicSolver::Entries &changes) const {
        Eigen::MatrixXcd A =
            (K + spin * Kc - w * w * M) + std::complex<double>(0, w) * (C + spin * G);
        for (const auto &change : changes)
            A(change.row(), change.col()) += change.value();
        return A;
    }
};

TEST(HarmonicSolve, agrees_with_a_dense_complex_solution_at_every_speed) {
    const int n = 7;
    const Eigen::MatrixXd M = numbers(n, 0.3);
    const Eigen::MatrixXd C = numbers(n, 0.7);
    Eigen::MatrixXd G = numbers(n, 1.1);
    G.row(2).setZero();
    const Eigen::MatrixXd K = numbers(n, 1.9) + 8 * Eigen::MatrixXd::Identity(n, n);
    const Eigen::MatrixXd Kc = numbers(n, 2.9);
    HarmonicSolver solver({sparse(M), sparse(C), sparse(G), sparse(K), sparse(Kc)});
    EXPECT_FALSE(solver.conserves());
    EXPECT_EQ(solver.size(), n);
    Eigen::MatrixXcd f(n, 2);
    f.real() = numbers(n, 4.1).leftCols(2);
    f.imag() = numbers(n, 5.3).leftCols(2);
    const std::complex<double> i(0, 1);
    for (const double s : {0.0, 0.4, -1.3, 2.5}) {
        const Eigen::MatrixXcd A = (K + s * Kc - s * s * M) + i * s * (C + s * G);
        const Eigen::MatrixXcd found = solver.solve(s, f);
        const Eigen::MatrixXcd expected = A.partialPivLu().solve(f);
        EXPECT_LT((found - expected).norm(), 1e-12 * expected.norm()) << s;
        EXPECT_LT((A * found - f).cwiseAbs().maxCoeff(),
                  1e-14 * (A.cwiseAbs() * found.cwiseAbs() + f.cwiseAbs()).maxCoeff());
        const Eigen::MatrixXd sizes = K.cwiseAbs() + std::abs(s) * (Kc.cwiseAbs() + C.cwiseAbs()) +
                                      s * s * (M.cwiseAbs() + G.cwiseAbs());
        for (Eigen::Index column = 0; column < 2; ++column) {
            EXPECT_LT(solver.rounding(f.col(column), found.col(column)), 1e-12);
            const Eigen::VectorXd u = found.col(column).cwiseAbs();
            const double form = u.dot(sizes * u);
            EXPECT_NEAR(solver.absolute_form(found.col(column)), form, 1e-13 * form);
        }
    }
}

/// The frequency need not be the spin speed, and terms with the square of that are there; pivots of
/// a matrix that has changed by orders of magnitude since do not serve, and are not kept.
TEST(HarmonicSolve, agrees_with_a_dense_solution_at_any_spin_speed_and_frequency) {
    const int n = 9;
    const Eigen::MatrixXd M = numbers(n, 0.3);
    const Eigen::MatrixXd C = numbers(n, 0.7);
    const Eigen::MatrixXd G = numbers(n, 1.1);
    const Eigen::MatrixXd K = numbers(n, 1.9) + 8 * Eigen::MatrixXd::Identity(n, n);
    const Eigen::MatrixXd Kc = numbers(n, 2.9);
    const Eigen::MatrixXd Kss = numbers(n, 3.7);
    HarmonicSolver solver({sparse(M), sparse(C), sparse(G), sparse(K), sparse(Kc), sparse(Kss)});
    Eigen::MatrixXcd f(n, 1);
    f.real() = numbers(n, 4.1).leftCols(1);
    f.imag() = numbers(n, 5.3).leftCols(1);
    const std::complex<double> i(0, 1);
    for (const double spin : {0.0, 0.4, -1.3, 2.5, 900.0})
        for (const double w : {0.0, 0.7, 3.1, -2.0, 4000.0, 1e-3}) {
            const Eigen::MatrixXcd A =
                (K + spin * Kc + spin * spin * Kss - w * w * M) + i * w * (C + spin * G);
            const Eigen::MatrixXcd found = solver.solve(spin, w, f);
            const Eigen::PartialPivLU<Eigen::MatrixXcd> dense(A);
            const Eigen::MatrixXcd expected = dense.solve(f);
            // What rounding of the entries of A does to either solution.
            EXPECT_LT((found - expected).norm(), 1e-15 / dense.rcond() * expected.norm())
                << spin << ' ' << w;
            EXPECT_LT((A * found - f).cwiseAbs().maxCoeff(),
                      1e-14 * (A.cwiseAbs() * found.cwiseAbs() + f.cwiseAbs()).maxCoeff());
        }
}

/// Unknowns in pairs (x, y) are solved for as the parts that turn with and against: whatever
/// couples them, and with entries that are added to the terms, it is the same solution.
TEST(HarmonicSolve, pairs_have_the_solution_of_the_unknowns_as_they_are) {
    const int n = 8;
    const FullTerms full(n);
    const std::complex<double> i(0, 1);
    const HarmonicSolver::Entries changes{{3, 2, 0.7 + 0.2 * i}, {3, 3, -0.4 * i}, {0, 6, 1.5}};
    HarmonicSolver solver(full.terms(), true, changes);
    Eigen::MatrixXcd f(n, 2);
    f.real() = numbers(n, 4.1).leftCols(2);
    f.imag() = numbers(n, 5.3).leftCols(2);
    for (const bool changed : {false, true})
        for (const double spin : {0.0, 0.4, -1.3})
            for (const double w : {0.0, 0.7, -2.0}) {
                const auto added = changed ? changes : HarmonicSolver::Entries{};
                const Eigen::MatrixXcd found = solver.solve(spin, w, f, added);
                const Eigen::PartialPivLU<Eigen::MatrixXcd> dense(full.at(spin, w, added));
                const Eigen::MatrixXcd expected = dense.solve(f);
                // What rounding of the entries of A does to either solution.
                EXPECT_LT((found - expected).norm(), 1e-15 / dense.rcond() * expected.norm())
                    << spin << ' ' << w;
                EXPECT_LT(solver.rounding(f.col(0), found.col(0)), 1e-15 / dense.rcond());
                EXPECT_GT(solver.rounding(f.col(0), found.col(0)), 1e-17);
            }
}

/// What is the same from every direction does not couple the two parts: one is solved for without
/// the other, and where it is not driven it is zero to the last digit.
TEST(HarmonicSolve, parts_that_nothing_couples_stay_apart) {
    const int n = 6;
    Eigen::MatrixXd planar = numbers(n / 2, 1.9);
    planar = planar * planar.transpose() + Eigen::MatrixXd::Identity(n / 2, n / 2);
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n, n);
    Eigen::MatrixXd G = K;
    for (int row = 0; row < n / 2; ++row)
        for (int column = 0; column < n / 2; ++column) {
            K(2 * row, 2 * column) = K(2 * row + 1, 2 * column + 1) = planar(row, column);
            G(2 * row, 2 * column + 1) = planar(row, column) / 3;
            G(2 * row + 1, 2 * column) = -planar(row, column) / 3;
        }
    HarmonicSolver solver({sparse(Eigen::MatrixXd::Identity(n, n)), Matrix::from_entries(n, {}),
                           sparse(G), sparse(K), Matrix::from_entries(n, {})},
                          true);
    const std::complex<double> i(0, 1);
    Eigen::MatrixXcd forward(n, 1);
    for (int k = 0; k < n / 2; ++k) {
        forward(2 * k) = 1.0 + k;
        forward(2 * k + 1) = -i * (1.0 + k);
    }
    const Eigen::MatrixXcd found = solver.solve(0.6, forward);
    for (int k = 0; k < n / 2; ++k)
        EXPECT_EQ(found(2 * k + 1), -i * found(2 * k)) << k;
    const Eigen::MatrixXcd A =
        K.cast<std::complex<double>>() + i * 0.36 * G - 0.36 * Eigen::MatrixXcd::Identity(n, n);
    EXPECT_LT((A * found - forward).norm(), 1e-14 * forward.norm());
}

/// The factors that are kept for further loads are those of this spin speed, this frequency and
/// these changes alone.
TEST(HarmonicSolve, one_after_another_at_a_speed_have_the_solutions_of_their_own_matrices) {
    const int n = 8;
    const FullTerms full(n);
    const std::complex<double> i(0, 1);
    const HarmonicSolver::Entries none;
    const HarmonicSolver::Entries some{{3, 2, 0.7 + 0.2 * i}, {0, 6, 1.5}};
    const HarmonicSolver::Entries others{{3, 2, 0.7 + 0.2 * i}, {0, 6, 1.25}};
    HarmonicSolver solver(full.terms(), true, some);
    struct At {
        double spin, frequency;
        const HarmonicSolver::Entries &changes;
    };
    double seed = 4.1;
    for (const At &at :
         {At{0.4, 0.7, none}, At{0.4, 0.7, none}, At{0.4, 0.7, some}, At{0.4, 0.7, others},
          At{0.4, 0.7, others}, At{0.4, 0.7, none}, At{0.7, 0.4, none}, At{-0.7, 0.4, none},
          At{-0.7, -0.4, none}, At{0, -0.4, none}, At{0, 0, none}, At{0, 0, none}}) {
        const Eigen::MatrixXcd f = numbers(n, seed += 0.6).leftCols(2).cast<std::complex<double>>();
        const Eigen::MatrixXcd found = solver.solve(at.spin, at.frequency, f, at.changes);
        const Eigen::PartialPivLU<Eigen::MatrixXcd> dense(
            full.at(at.spin, at.frequency, at.changes));
        const Eigen::MatrixXcd expected = dense.solve(f);
        // What rounding of the entries of A does to either solution.
        EXPECT_LT((found - expected).norm(), 1e-15 / dense.rcond() * expected.norm())
            << at.spin << ' ' << at.frequency;
    }
}

TEST(HarmonicSolve, singular_matrix_is_refused_or_seen_in_the_rounding) {
    Eigen::MatrixXd stiffness(2, 2);
    stiffness << 2, -1, -1, 2; // eigenvalues 1 and 3
    HarmonicSolver solver({sparse(Eigen::MatrixXd::Identity(2, 2)), Matrix::from_entries(2, {}),
                           Matrix::from_entries(2, {}), sparse(stiffness),
                           Matrix::from_entries(2, {})});
    EXPECT_TRUE(solver.conserves());
    const Eigen::MatrixXcd f = Eigen::MatrixXcd::Identity(2, 1);
    EXPECT_THROW((void)solver.solve(1.0, f), SolverError);
    EXPECT_THROW((void)solver.solve(1.0, f), SolverError); // nor are its factors kept
    const auto rounding_at = [&](double speed) {
        const Eigen::VectorXcd found = solver.solve(speed, f);
        return solver.rounding(f, found);
    };
    EXPECT_GT(rounding_at(std::sqrt(3.0)), 1e-3);
    // The solver is good for other speeds afterwards.
    EXPECT_LT(rounding_at(2.0), 1e-14);
}

/// Two masses on a soft spring, joined by one that is 2^40 times as stiff: in double precision the
/// motion of both together is off by up to 1e-16 times that. Closed form, in which nothing cancels.
TEST(HarmonicSolve, smooth_solutions_keep_the_digits_that_a_stiff_spring_takes) {
    const double stiff = std::pow(2.0, 40);
    const double soft = std::pow(2.0, 10); // the sum of both is exact
    Eigen::MatrixXd K(2, 2);
    K << soft + stiff, -stiff, -stiff, stiff;
    const Eigen::MatrixXd M = Eigen::Vector2d(3, 5).asDiagonal();
    HarmonicSolver smooth({sparse(M), {}, {}, sparse(K), {}}, false, {}, true);
    HarmonicSolver plain({sparse(M), {}, {}, sparse(K), {}});
    const Eigen::MatrixXcd f = Eigen::Vector2cd(1, 0);
    double worst_plain = 0;
    for (const double w : {0.7, 3.1, 9.3, 11.2, 11.4, 20.9}) {
        const Eigen::MatrixXcd q = smooth.solve(w, f);
        const double determinant = stiff * (soft - w * w * 8) - w * w * 5 * (soft - w * w * 3);
        const Eigen::Vector2d exact((stiff - w * w * 5) / determinant, stiff / determinant);
        for (int k = 0; k < 2; ++k) {
            // Long double leaves 2^-11 of what double does, which is less than the noise told.
            EXPECT_LE(std::abs(q(k, 0) - exact(k)), 10 * smooth.noise() * std::abs(exact(k))) << w;
            worst_plain = std::max(worst_plain, std::abs(plain.solve(w, f)(k, 0) - exact(k)) /
                                                    std::abs(exact(k)));
        }
        EXPECT_LE(smooth.noise(), 1e-8) << w;
    }
    EXPECT_GT(worst_plain, 1e-8);
}

} // namespace
