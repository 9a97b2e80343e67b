#include "linalg/dense/band_matrix.h"

#include "linalg/check.h"

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

} // namespace
