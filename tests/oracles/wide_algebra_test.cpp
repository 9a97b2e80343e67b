// Their own linear algebra in long double, against matrices whose eigenvalues are known.

#include "oracles/wide_algebra.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace whirl::oracles {

namespace {

constexpr Real wide_digits = 1e-15L;

/// The largest distance of a value from the nearest one found.
double farthest(const std::vector<Complex> &found, const std::vector<Complex> &values) {
    Real out = found.size() == values.size() ? 0 : 1e3L;
    for (const Complex &value : values) {
        Real nearest = 1e3L;
        for (const Complex &other : found)
            nearest = std::min(nearest, std::abs(other - value));
        out = std::max(out, nearest);
    }
    return static_cast<double>(out);
}

} // namespace

// A turn of the unknowns is orthogonal: without shifts of no meaning the steps would stand still.
TEST(WideAlgebra, eigenvalues_of_a_permutation_are_roots_of_one) {
    for (const int n : {3, 4, 8}) {
        RealMatrix turn = RealMatrix::Zero(n, n);
        std::vector<Complex> roots;
        for (int k = 0; k < n; ++k) {
            turn((k + 1) % n, k) = 1;
            roots.push_back(std::polar(Real(1), 2 * std::numbers::pi_v<Real> * k / n));
        }
        EXPECT_LT(farthest(eigenvalues(turn), roots), static_cast<double>(wide_digits)) << n;
    }
}

TEST(WideAlgebra, eigenvalues_of_a_full_matrix_are_those_it_was_made_of) {
    RealMatrix blocks = RealMatrix::Zero(5, 5); // 3, -2, 0.5 and 1 +- 4i
    blocks.diagonal() << 3, -2, 0.5L, 1, 1;
    blocks(3, 4) = 4;
    blocks(4, 3) = -4;
    RealMatrix base(5, 5);
    for (int i = 0; i < 5; ++i)
        for (int j = 0; j < 5; ++j)
            base(i, j) = std::cos(Real(1 + 3 * i + 7 * j * j)) + (i == j ? 2 : 0);
    const RealMatrix full = product(base, product(blocks, inverse(base)));
    const std::vector<Complex> found = eigenvalues(full);
    EXPECT_LT(farthest(found, {3, -2, 0.5L, Complex(1, 4), Complex(1, -4)}),
              static_cast<double>(wide_digits));
    EXPECT_NEAR(static_cast<double>(determinant(full)), 3 * -2 * 0.5 * 17, 1e-13);
}

TEST(WideAlgebra, hermitian_eigenvalues_ascend_and_stand_once) {
    ComplexMatrix A(2, 2); // 2 +- |1 + 2i|
    A << Real(2), Complex(1, 2), Complex(1, -2), Real(2);
    const std::vector<Real> found = hermitian_eigenvalues(A);
    ASSERT_EQ(found.size(), 2U);
    EXPECT_NEAR(static_cast<double>(found[0]), 2 - std::sqrt(5.0), 1e-15);
    EXPECT_NEAR(static_cast<double>(found[1]), 2 + std::sqrt(5.0), 1e-15);
}

TEST(WideAlgebra, solves_with_a_zero_in_the_first_place) {
    ComplexMatrix A(3, 3);
    A << Real(0), Complex(0, 2), Real(1), Real(3), Real(1), Complex(1, 1), Real(1), Real(4),
        Complex(0, -1);
    ComplexMatrix x(3, 1);
    x << Complex(1, 2), Real(-1), Complex(0, 3);
    const ComplexMatrix b = A.lazyProduct(x);
    EXPECT_LT(static_cast<double>((solve(A, b) - x).cwiseAbs().maxCoeff()), 1e-17);
}

} // namespace whirl::oracles
