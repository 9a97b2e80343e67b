// Stiffness matrices of elements of any length against their thickness: the basis is not nearly
// dependent, so that no digits are lost to it.

#include "elements/beam.h"
#include "elements/test_beams.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

namespace {

using namespace whirl;

class Conditioning : public ::testing::TestWithParam<int> {};

/// With the first node held and unknowns scaled to unit diagonal. Where the two sets of internal
/// functions change places (Phi = 1), slope and bending functions of degree k differ in energy by a
/// share of 12 |I L_k|^2 / |L_k|^2, about 3/k^2 of which the couplings leave a part: 1e-4 up to
/// order 8, where functions without shear strain leave h^2/d^2.
TEST_P(Conditioning, BoundedWhateverTheLength) {
    for (const double length : {1e-9, 1e-6, 1e-4, 1e-3, 1e-2, 0.03, 0.1, 0.3, 1.0, 10.0, 1000.0}) {
        elements::Beam beam = tests::beam_of(tests::solid_cylinder());
        beam.span.length = length;
        const Eigen::MatrixXd K = elements::beam_matrices(beam, GetParam()).K;
        const auto n = K.rows() - 2;
        const Eigen::MatrixXd held = K.bottomRightCorner(n, n);
        const Eigen::VectorXd scale = held.diagonal().cwiseSqrt().cwiseInverse();
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(
            Eigen::MatrixXd(scale.asDiagonal() * held * scale.asDiagonal()));
        EXPECT_GT(solver.eigenvalues().minCoeff() / solver.eigenvalues().maxCoeff(), 1e-4)
            << length;
    }
}

/// Functions of an order are among those of a higher one, at the places that are told.
TEST_P(Conditioning, FunctionsOfAHigherOrderContainThoseOfALower) {
    for (const double length : {0.01, 1.0}) {
        elements::Beam beam = tests::beam_of(tests::solid_cylinder());
        beam.span.length = length;
        const int higher = GetParam() + 4;
        const std::vector<int> places = elements::internal_places(beam, GetParam(), higher);
        ASSERT_EQ(std::ssize(places), elements::internal_unknowns(GetParam()));
        for (const double xi : {0.1, 0.37, 0.8}) {
            const elements::ShapeValues low = elements::beam_shapes(beam, GetParam(), xi);
            const elements::ShapeValues high = elements::beam_shapes(beam, higher, xi);
            for (int i = 0; i < low.w.size(); ++i) {
                const int j = i < 4 ? i : 4 + places[static_cast<std::size_t>(i - 4)];
                EXPECT_NEAR(low.w(i), high.w(j), 1e-14 * (1 + length));
                EXPECT_NEAR(low.phi(i), high.phi(j), 1e-14 / length);
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Orders, Conditioning, ::testing::Values(1, 2, 3, 4, 6, 8));

} // namespace
