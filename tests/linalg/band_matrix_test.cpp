#include "linalg/dense/band_matrix.h"

#include "linalg/check.h"
#include "linalg/lanes/vector_products.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace whirl::linalg;

/// Entries without a pattern; the diagonal is small, so that rows must be exchanged.
std::complex<double> number(int i, int j) {
    const std::complex<double> value(std::sin(1.7 * i * i + 2.3 * j), std::cos(0.9 * i - j * j));
    return i == j ? 1e-9 * value : value;
}

TEST(BandMatrix, agrees_with_a_dense_solution) {
    for (const int width : {1, 3, 7})
        for (const int size : {1, 2, 9, 40}) {
            BandMatrix band(size, width);
            for (int pass = 0; pass < 2; ++pass) { // again after clear()
                band.clear();
                Eigen::MatrixXcd dense = Eigen::MatrixXcd::Zero(size, size);
                for (int i = 0; i < size; ++i)
                    for (int j = std::max(0, i - width); j <= std::min(size - 1, i + width); ++j)
                        band(i, j) = dense(i, j) = number(i + pass, j);
                Eigen::VectorXcd b(size);
                for (int i = 0; i < size; ++i)
                    b(i) = number(i, 3 * i + 1);
                const Eigen::VectorXcd expected = dense.partialPivLu().solve(b);
                band.eliminate();
                // Rounding times the condition of such small matrices.
                EXPECT_LT((band.solve(b) - expected).norm(), 1e-10 * expected.norm())
                    << size << " x " << size << ", width " << width;
            }
        }
}

TEST(BandMatrix, singular_matrix_is_refused) {
    BandMatrix band(3, 1);
    band(0, 0) = 1;
    band(0, 1) = 2;
    band(1, 0) = 2;
    band(1, 1) = 4;
    band(2, 2) = 1;
    EXPECT_THROW(band.eliminate(), SolverError);
}

// Sizes that fill the lanes and sizes that do not, against sums entry by entry.
TEST(VectorProducts, AreTheSumsEntryByEntry) {
    const std::complex<double> f(0.3, -1.7);
    for (const int size : {0, 1, 2, 3, 4, 7, 32}) {
        Eigen::VectorXcd a(size);
        Eigen::VectorXcd b(size);
        std::complex<double> sum = 0;
        for (int k = 0; k < size; ++k) {
            a(k) = number(k, 1);
            b(k) = number(2, k);
            sum += std::conj(a(k)) * b(k);
        }
        EXPECT_NEAR(std::abs(dot(a, b) - sum), 0, 1e-15 * (1 + size));
        Eigen::VectorXcd y = b;
        add_multiple(f, a, y);
        for (int k = 0; k < size; ++k)
            EXPECT_NEAR(std::abs(y(k) - (b(k) + f * a(k))), 0, 4e-16 * 4);
    }
}

// Sizes below, at and beyond those of a block; entries are at most 1, the tolerances some
// roundings.
TEST(VectorProducts, OfColumnsSumsAndLanesAreThoseOfEigen) {
    constexpr double rounding = 4e-16;
    for (const Eigen::Index size : {1, 2, 3, 7, 8, 9, 40}) {
        const Eigen::MatrixXcd A = Eigen::MatrixXcd::Random(size, 4);
        const Eigen::MatrixXcd B = Eigen::MatrixXcd::Random(size, 3);
        const std::complex<double> product = (A.col(2).transpose() * B.col(1)).value();
        EXPECT_NEAR(std::abs(product_of_columns(A, 2, B, 1) - product), 0,
                    rounding * static_cast<double>(4 + size));

        std::vector<Eigen::VectorXcd> vectors;
        Vector4 four(static_cast<std::size_t>(size));
        Complex4 factors{};
        for (int lane = 0; lane < lanes; ++lane) {
            vectors.emplace_back(A.col(lane));
            factors.set(lane, B(0, lane % 3));
            for (Eigen::Index k = 0; k < size; ++k)
                four[static_cast<std::size_t>(k)].set(lane, A(k, lane));
        }
        const Eigen::VectorXcd sum = sum_of({{0.3, &vectors[0]}, {-2.5, &vectors[3]}});
        EXPECT_NEAR((sum - (0.3 * A.col(0) - 2.5 * A.col(3))).cwiseAbs().maxCoeff(), 0,
                    5 * rounding);
        const std::array<Eigen::VectorXcd, lanes> scaled = vectors_of(four, factors);
        for (int lane = 0; lane < lanes; ++lane)
            EXPECT_NEAR((scaled[static_cast<std::size_t>(lane)] - factors.at(lane) * A.col(lane))
                            .cwiseAbs()
                            .maxCoeff(),
                        0, 2 * rounding);
    }
}

} // namespace
