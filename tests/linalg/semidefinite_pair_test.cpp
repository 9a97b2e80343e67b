#include "linalg/semidefinite_pair.h"

#include <Eigen/Dense>
#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <cmath>

namespace semidefinite_pair_test {

using whirl::linalg::SemidefinitePair;
using Sparse = Eigen::SparseMatrix<double>;

/// Chain of springs between masses, both ends on springs of stiffness `ground`.
Eigen::MatrixXd chain(int n, double ground) {
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n, n);
    for (int i = 0; i + 1 < n; ++i) {
        K(i, i) += 1;
        K(i + 1, i + 1) += 1;
        K(i, i + 1) = K(i + 1, i) = -1;
    }
    K(0, 0) += ground;
    K(n - 1, n - 1) += ground;
    return K;
}

Sparse sparse(const Eigen::MatrixXd &A) { return A.sparseView(); }

TEST(SemidefinitePair, FindsTheClosedFormOfAChain) {
    const int n = 40; // fixed at both ends: w_k = 2 sin(k pi / (2 (n + 1)))
    const SemidefinitePair pair(sparse(chain(n, 1)), sparse(Eigen::MatrixXd::Identity(n, n)));
    const std::vector<double> roots = pair.roots(0.1, 1.5);
    std::vector<double> expected;
    for (int k = 1; k <= n; ++k) {
        const double w = 2 * std::sin(k * M_PI / (2 * (n + 1)));
        if (w > 0.1 && w < 1.5)
            expected.push_back(w);
    }
    ASSERT_EQ(roots.size(), expected.size());
    for (std::size_t i = 0; i < roots.size(); ++i)
        EXPECT_NEAR(roots[i], expected[i], 1e-13);
    EXPECT_EQ(pair.count_below(10), n);
}

TEST(SemidefinitePair, FreeChainAndIndefiniteMass) {
    const int n = 12;
    Eigen::VectorXd mass = Eigen::VectorXd::Ones(n);
    mass(3) = -0.5;
    mass(7) = 0;
    const Eigen::MatrixXd A = mass.asDiagonal();
    const Eigen::MatrixXd K = chain(n, 0);
    const std::vector<double> roots = SemidefinitePair(sparse(K), sparse(A)).roots(1e-3, 5);
    // K + t A is positive definite for small t > 0; its roots with A are sqrt(w^2 + t).
    const double t = 1e-2;
    const Eigen::MatrixXcd right = (K + t * A).cast<std::complex<double>>();
    const Eigen::MatrixXcd left = A.cast<std::complex<double>>();
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXcd> pair(left, right);
    ASSERT_EQ(pair.info(), Eigen::Success);
    const Eigen::VectorXd mu = pair.eigenvalues();
    std::vector<double> expected;
    for (Eigen::Index i = n - 1; i >= 0; --i)
        if (mu(i) > 1e-12 && 1 / mu(i) - t > 1e-6)
            expected.push_back(std::sqrt(1 / mu(i) - t));
    ASSERT_EQ(roots.size(), expected.size());
    for (std::size_t i = 0; i < roots.size(); ++i)
        EXPECT_NEAR(roots[i], expected[i], 1e-11);
}

TEST(SemidefinitePair, MultipleRootsAreRepeated) {
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(6, 6);
    K.diagonal() << 1, 4, 4, 4, 9, 9;
    const SemidefinitePair pair(sparse(K), sparse(Eigen::MatrixXd::Identity(6, 6)));
    const std::vector<double> roots = pair.roots(0.5, 2.5);
    ASSERT_EQ(roots.size(), 4U);
    EXPECT_NEAR(roots[0], 1, 1e-12);
    for (const std::size_t i : {1U, 2U, 3U})
        EXPECT_NEAR(roots[i], 2, 1e-11);
    EXPECT_TRUE(pair.roots(4, 5).empty());
    EXPECT_TRUE(SemidefinitePair(Sparse(0, 0), Sparse(0, 0)).roots(0, 1).empty());
}

} // namespace semidefinite_pair_test
