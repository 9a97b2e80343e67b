// Patch tests: states of constant curvature and constant shear, and what statics gives exactly.

#include "elements/test_beams.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace {

using namespace whirl;

/// Deflection and slope at the free end of a cantilever (first node clamped) under an end force
/// and an end moment.
Eigen::Vector2d cantilever(const elements::Beam &beam, int order, double force, double moment) {
    const Eigen::MatrixXd K = elements::beam_matrices(beam, order).K;
    const Eigen::Index n = K.rows() - 2;
    Eigen::VectorXd f = Eigen::VectorXd::Zero(n);
    f(0) = force;
    f(1) = moment;
    const Eigen::MatrixXd held = K.bottomRightCorner(n, n);
    const Eigen::VectorXd u = held.partialPivLu().solve(f);
    return u.head(2);
}

class Statics : public testing::TestWithParam<int> {};

TEST_P(Statics, UniformCantileverUnderEndLoadsIsExact) {
    for (const tests::Cone &cone : {tests::solid_cylinder(), tests::hollow_cylinder()}) {
        const elements::Beam beam = tests::beam_of(cone);
        const elements::Section s = beam.at(0);
        const double L = cone.length;
        // Constant curvature.
        const Eigen::Vector2d bent = cantilever(beam, GetParam(), 0, 7.0);
        EXPECT_NEAR(bent(0), 7 * L * L / (2 * s.EI), 1e-12 * bent(0));
        EXPECT_NEAR(bent(1), 7 * L / s.EI, 1e-12 * bent(1));
        // Linear curvature and constant shear.
        const Eigen::Vector2d loaded = cantilever(beam, GetParam(), 3.0, 0);
        const double tip = 3 * L * L * L / (3 * s.EI) + 3 * L / s.kappaGA;
        EXPECT_NEAR(loaded(0), tip, 1e-12 * tip);
        EXPECT_NEAR(loaded(1), 3 * L * L / (2 * s.EI), 1e-12 * loaded(1));
    }
}

TEST_P(Statics, CondensedStiffnessIsThatOfTheExactTimoshenkoBeam) {
    const tests::Cone cone = tests::hollow_cylinder();
    const elements::Beam beam = tests::beam_of(cone);
    const elements::Section s = beam.at(0);
    const Eigen::MatrixXd K = elements::beam_matrices(beam, GetParam()).K;
    const Eigen::Index inner = K.rows() - 4;
    Eigen::MatrixXd nodal = K.topLeftCorner(4, 4);
    if (inner > 0) {
        const Eigen::MatrixXd inside = K.bottomRightCorner(inner, inner);
        const Eigen::MatrixXd across = K.bottomLeftCorner(inner, 4);
        const Eigen::MatrixXd moved = inside.partialPivLu().solve(across);
        nodal -= across.transpose() * moved;
    }
    // Przemieniecki (1968), eq. (5.116), rows w0, phi0, w1, phi1.
    const double h = cone.length;
    const double Phi = 12 * s.EI / (s.kappaGA * h * h);
    Eigen::Matrix4d exact;
    exact << 12, 6 * h, -12, 6 * h,                          //
        6 * h, (4 + Phi) * h * h, -6 * h, (2 - Phi) * h * h, //
        -12, -6 * h, 12, -6 * h,                             //
        6 * h, (2 - Phi) * h * h, -6 * h, (4 + Phi) * h * h;
    exact *= s.EI / (h * h * h * (1 + Phi));
    EXPECT_LT((nodal - exact).norm(), 1e-12 * exact.norm());
}

INSTANTIATE_TEST_SUITE_P(Orders, Statics, testing::Values(1, 2, 4, 7, 10));

/// Relative error of the tip deflection of a conical cantilever under an end force; exact:
/// int (L-z)^2/EI + 1/(kappa G A) dz with r linear between r1 and r2 = 4 L^3/(3 pi E r1^3 r2) +
/// L/(kappa G pi r1 r2).
double cone_error(int order) {
    const tests::Cone cone = tests::solid_cone();
    const elements::Beam beam = tests::beam_of(cone);
    const double r1 = cone.outer_start;
    const double r2 = cone.outer_end;
    const double L = cone.length;
    const double nu = tests::young / (2 * tests::shear_modulus) - 1;
    const double kappa = 6 * (1 + nu) / (7 + 6 * nu); // Cowper, solid circle
    const double exact = 4 * L * L * L / (3 * std::numbers::pi * tests::young * r1 * r1 * r1 * r2) +
                         L / (kappa * tests::shear_modulus * std::numbers::pi * r1 * r2);
    return std::abs(cantilever(beam, order, 1, 0)(0) / exact - 1);
}

TEST(ConeStatics, TipDeflectionConvergesExponentiallyInTheOrder) {
    // The compliance 1/r^4 is analytic: each order multiplies the error by about the same factor.
    EXPECT_LT(cone_error(2), 2e-2);
    EXPECT_LT(cone_error(4), 1e-2 * cone_error(2));
    EXPECT_LT(cone_error(7), 1e-3 * cone_error(4));
    EXPECT_LT(cone_error(10), 1e-11);
    // The classical element integrates a cone's stiffness with shapes of a uniform beam.
    EXPECT_GT(cone_error(1), 1e-4);
}

} // namespace
