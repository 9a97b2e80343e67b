#include "closed_form/anisotropic_rotor_polynomial.h"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>

namespace whirl::closed_form {
namespace {

/// Half a unit of the sixth printed decimal.
constexpr double printed = 0.5e-6;

AnisotropicRotor figure_rotor(double polar_inertia = 0.8) {
    return {polar_inertia, 0.1, 1.25, 0.156};
}

/// Largest real part of the roots of the quartic, from its companion matrix.
double growth(const AnisotropicRotor &rotor, double speed) {
    const auto a = characteristic_polynomial(rotor, speed);
    Eigen::MatrixXd companion = Eigen::MatrixXd::Zero(4, 4);
    companion.bottomLeftCorner<3, 3>().setIdentity();
    for (int row = 0; row < 4; ++row)
        companion(row, 3) = -a[4 - row] / a[0];
    return companion.eigenvalues().real().maxCoeff();
}

/// Largest real part of the tilt motion in the rotating frame, from the equations of motion of the
/// two slopes (independent of the expanded polynomial).
double growth_from_equations(const AnisotropicRotor &r, double w) {
    const double p2 = r.frequency * r.frequency;
    const double g = 2.0 - r.polar_inertia;
    const double a1 = 1.0 - r.anisotropy;
    const double a2 = 1.0 + r.anisotropy;
    Eigen::Matrix2d damping;
    damping << r.damping, -g * w, g * w, r.damping;
    Eigen::Matrix2d stiffness;
    stiffness << p2 + (r.polar_inertia - a1) * w * w, -r.damping * w, r.damping * w,
        p2 + (r.polar_inertia - a2) * w * w;
    const Eigen::Matrix2d inverse_mass = Eigen::Vector2d(1.0 / a2, 1.0 / a1).asDiagonal();
    Eigen::MatrixXd state = Eigen::MatrixXd::Zero(4, 4);
    state.topRightCorner<2, 2>().setIdentity();
    state.bottomLeftCorner<2, 2>() = -inverse_mass * stiffness;
    state.bottomRightCorner<2, 2>() = -inverse_mass * damping;
    return state.eigenvalues().real().maxCoeff();
}

TEST(AnisotropicRotor, NumbersOfTheFigure) {
    const auto speeds = critical_speeds(figure_rotor());
    ASSERT_EQ(speeds.size(), 2U);
    EXPECT_NEAR(speeds[0], 2.282177, printed);
    EXPECT_NEAR(speeds[1], 3.952847, printed);

    const auto band = unstable_band(figure_rotor());
    ASSERT_TRUE(band && band->to);
    EXPECT_NEAR(band->from, 2.381264, printed);
    EXPECT_NEAR(*band->to, 3.788366, printed);

    const auto permissible = permissible_anisotropy(figure_rotor());
    EXPECT_NEAR(permissible.anisotropy, 0.055266, printed);
    ASSERT_TRUE(permissible.spin_speed);
    EXPECT_NEAR(*permissible.spin_speed, 2.851144, printed);
}

TEST(AnisotropicRotor, NearlySphericalRotorHasNoUpperEnd) {
    const double inertias[] = {0.95, 1.0, 1.05};
    const double ends[] = {3.36, 4.11, 5.81};
    for (int i = 0; i < 3; ++i) {
        const auto band = unstable_band(figure_rotor(inertias[i]));
        ASSERT_TRUE(band);
        EXPECT_NEAR(band->from, ends[i], 0.5e-2);
        EXPECT_FALSE(band->to);
        EXPECT_TRUE(band->contains(1e6));
        EXPECT_EQ(critical_speeds(figure_rotor(inertias[i])).size(), 1U);
    }
}

TEST(AnisotropicRotor, BoundaryOfTheRegimes) {
    // 1 - C = a: one end, x > p^4/(2 p^2 (1 - C) - h^2).
    const auto upper = unstable_band(figure_rotor(0.9));
    ASSERT_TRUE(upper);
    EXPECT_NEAR(upper->from, std::sqrt(std::pow(1.25, 4) / (0.2 * 1.5625 - 0.156 * 0.156)), 1e-12);
    EXPECT_FALSE(upper->to);
    // C - 1 = a: the right side is negative, never unstable.
    EXPECT_FALSE(unstable_band(figure_rotor(1.1)));
    EXPECT_FALSE(unstable_band(figure_rotor(1.3)));
    EXPECT_TRUE(critical_speeds(figure_rotor(1.3)).empty());
}

TEST(AnisotropicRotor, UndampedBandLiesBetweenTheCriticalSpeeds) {
    auto rotor = figure_rotor();
    rotor.damping = 0.0;
    const auto band = unstable_band(rotor);
    const auto speeds = critical_speeds(rotor);
    EXPECT_NEAR(band->from, speeds[0], 1e-14);
    EXPECT_NEAR(*band->to, speeds[1], 1e-14);
}

TEST(AnisotropicRotor, EqualCriticalSpeedsAreListedOnce) {
    auto rotor = figure_rotor();
    rotor.anisotropy = 0.0;
    EXPECT_EQ(critical_speeds(rotor).size(), 1U);
    EXPECT_FALSE(unstable_band(rotor));
}

TEST(AnisotropicRotor, HurwitzDeterminantIsTheSumOfSquares) {
    std::mt19937 generator(1);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int i = 0; i < 1000; ++i) {
        const AnisotropicRotor rotor{2.0 * unit(generator), 0.9 * unit(generator),
                                     0.2 + unit(generator), unit(generator)};
        const double speed = 3.0 * unit(generator);
        const auto [a0, a1, a2, a3, a4] = characteristic_polynomial(rotor, speed);
        const double direct = a1 * a2 * a3 - a0 * a3 * a3 - a1 * a1 * a4;
        const double scale = std::abs(a1 * a2 * a3) + a0 * a3 * a3 + std::abs(a1 * a1 * a4);
        EXPECT_NEAR(hurwitz_determinant(rotor, speed), direct, 1e-14 * scale);
    }
}

// Band against eigenvalues of the equations of motion, all regimes.
TEST(AnisotropicRotor, BandAgreesWithTheEigenvaluesInEveryRegime) {
    std::mt19937 generator(7);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    int unstable = 0;
    for (int i = 0; i < 4000; ++i) {
        const AnisotropicRotor rotor{0.5 + unit(generator), 0.4 * unit(generator), 1.25,
                                     0.02 + 0.3 * unit(generator)};
        const double speed = 8.0 * unit(generator);
        const double rate = growth_from_equations(rotor, speed);
        if (std::abs(rate) < 1e-9)
            continue;
        const auto band = unstable_band(rotor);
        const bool inside = band && band->contains(speed);
        unstable += inside ? 1 : 0;
        EXPECT_EQ(inside, rate > 0.0) << rotor.polar_inertia << ' ' << rotor.anisotropy;
        EXPECT_EQ(!inside, routh_hurwitz_stable(characteristic_polynomial(rotor, speed)));
        EXPECT_EQ(!inside, rotor.anisotropy < permissible_anisotropy(rotor, speed));
        // Companion roots: near-multiple roots cost half the digits.
        EXPECT_NEAR(growth(rotor, speed), rate, 1e-7);
    }
    EXPECT_GT(unstable, 500);
    EXPECT_LT(unstable, 3500);
}

TEST(AnisotropicRotor, PermissibleAnisotropyJustKeepsEverySpeedStable) {
    auto rotor = figure_rotor();
    const double limit = permissible_anisotropy(rotor).anisotropy;
    rotor.anisotropy = limit * (1.0 - 1e-9);
    EXPECT_FALSE(unstable_band(rotor));
    rotor.anisotropy = limit * (1.0 + 1e-9);
    EXPECT_TRUE(unstable_band(rotor));
}

TEST(AnisotropicRotor, HeavilyDampedLimitIsAnInfimum) {
    const AnisotropicRotor rotor{0.95, 0.0, 1.0, 0.8};
    const auto everywhere = permissible_anisotropy(rotor);
    EXPECT_NEAR(everywhere.anisotropy, 0.05, 1e-15);
    EXPECT_FALSE(everywhere.spin_speed);
    EXPECT_NEAR(permissible_anisotropy(rotor, 1e5), 0.05, 1e-8);
    EXPECT_GT(permissible_anisotropy(rotor, 1e3), 0.05);
}

TEST(AnisotropicRotor, PermissibleAnisotropyOverARange) {
    const auto rotor = figure_rotor();
    EXPECT_NEAR(permissible_anisotropy(rotor, 1.0, 5.0).anisotropy, 0.055266, printed);
    const auto below = permissible_anisotropy(rotor, 0.0, 2.0);
    EXPECT_EQ(below.spin_speed, 2.0);
    EXPECT_DOUBLE_EQ(below.anisotropy, permissible_anisotropy(rotor, 2.0));
    EXPECT_EQ(permissible_anisotropy(rotor, 4.0, 9.0).spin_speed, 4.0);
}

TEST(AnisotropicRotor, Types) {
    EXPECT_EQ(rotor_type(3.0, 1.0), RotorType::long_rotor);
    EXPECT_EQ(rotor_type(0.3, 0.1 + 0.2), RotorType::spherical);
    EXPECT_EQ(rotor_type(1.0, 1.8), RotorType::short_rotor);
}

} // namespace
} // namespace whirl::closed_form
