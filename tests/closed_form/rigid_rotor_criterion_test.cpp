#include "closed_form/rigid_rotor_functional.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace whirl::closed_form::rigid_rotor_criterion_test {
namespace {

/// Half a unit of the sixth printed decimal.
constexpr double printed = 0.5e-6;

TwoSupportRotor rotor_with(double diametral, double polar) {
    return two_support_rotor(60.0, diametral, polar, 2e6, 3e6, 0.4, 0.5);
}

/// Criterion straight from the functional: displacement of the plane z under a unit imbalance
/// there.
bool balances_at(const TwoSupportRotor &rotor, double z, double speed) {
    const Eigen::Vector2d moments(z, 1.0);
    return moments.dot(criterion_matrix(rotor, speed) * moments) < 0.0;
}

bool inside(const std::vector<Band> &bands, double speed) {
    return std::ranges::any_of(bands, [&](const Band &b) { return b.contains(speed); });
}

bool at_an_end(const std::vector<Band> &bands, double speed) {
    return std::ranges::any_of(bands, [&](const Band &b) {
        return std::abs(b.from - speed) < 1e-6 * speed ||
               (b.to && std::abs(*b.to - speed) < 1e-6 * speed);
    });
}

TEST(RigidRotorCriterion, NumbersOfTheLongRotor) {
    const auto rotor = rotor_with(3.0, 1.0);
    const auto speeds = resonances(rotor);
    ASSERT_EQ(speeds.size(), 2U);
    // 272.88605538508663 in forty-digit arithmetic.
    EXPECT_NEAR(speeds[0], 272.886055385087, 1e-11);
    EXPECT_NEAR(speeds[1], 737.473073, printed);
    EXPECT_NEAR(additional_speed(rotor, -0.3).value(), 512.017736, printed);
    EXPECT_NEAR(additional_speed(rotor, 0.0).value(), 731.436942, printed);
    EXPECT_NEAR(additional_speed(rotor, 0.2).value(), 474.341649, printed);
    EXPECT_NEAR(additional_speed(rotor, 0.45).value(), 320.390663, printed);
}

TEST(RigidRotorCriterion, PartialFrequenciesLieBetweenTheResonances) {
    const auto rotor = rotor_with(3.0, 1.0);
    const auto partial = partial_frequencies(rotor);
    const auto speeds = resonances(rotor);
    ASSERT_EQ(partial.size(), 2U);
    EXPECT_NEAR(partial[0], std::sqrt(5e6 / 60), 1e-11);
    EXPECT_NEAR(partial[1], std::sqrt((2e6 * 0.16 + 3e6 * 0.25) / 2), 1e-10);
    // w1 < wp1 < wp2 < w2, eq. (17) of the source.
    EXPECT_LT(speeds[0], partial[0]);
    EXPECT_LT(partial[0], partial[1]);
    EXPECT_LT(partial[1], speeds[1]);
    // The second one is the additional speed of the plane of the centre of mass.
    EXPECT_NEAR(partial[1], additional_speed(rotor, 0).value(), 1e-10);
    EXPECT_EQ(partial_frequencies(rotor_with(1.0, 1.9)).size(), 1U);
    EXPECT_FALSE(farthest_plane(rotor));
    TwoSupportRotor unequal = rotor_with(3.0, 1.0);
    unequal.anisotropy = 0.5; // A = 2.5 and 3.5
    ASSERT_EQ(partial_frequencies(unequal).size(), 3U);
    EXPECT_NEAR(partial_frequencies(unequal)[1], std::sqrt(1.07e6 / 1.5), 1e-10);
    EXPECT_NEAR(partial_frequencies(unequal)[2], std::sqrt(1.07e6 / 2.5), 1e-10);
}

TEST(RigidRotorCriterion, WithinTheFarthestPlaneAShortRotorIsBalancedForGood) {
    for (const double anisotropy : {0.0, 0.2}) {
        TwoSupportRotor rotor = rotor_with(1.0, 1.9);
        rotor.anisotropy = anisotropy;
        const auto z_max = farthest_plane(rotor);
        ASSERT_TRUE(z_max);
        EXPECT_NEAR(*z_max, std::sqrt((0.9 - anisotropy) / 60), 1e-15);
        for (const double side : {-1.0, 1.0}) {
            EXPECT_FALSE(static_balancing_bands(rotor, side * 0.999 * *z_max).back().to);
            EXPECT_TRUE(static_balancing_bands(rotor, side * 1.001 * *z_max).back().to);
        }
    }
    EXPECT_EQ(farthest_plane(rotor_with(2.0, 2.0)), std::optional(0.0));
}

TEST(RigidRotorCriterion, LongRotorBands) {
    const auto rotor = rotor_with(3.0, 1.0);
    const auto bands = static_balancing_bands(rotor, 0.2);
    ASSERT_EQ(bands.size(), 2U);
    EXPECT_NEAR(bands[0].from, 272.886055385087, 1e-11);
    EXPECT_NEAR(bands[0].to.value(), 474.341649, printed);
    EXPECT_NEAR(bands[1].from, 737.473073, printed);
    EXPECT_FALSE(bands[1].to);
    const auto dynamic = dynamic_balancing_bands(rotor);
    ASSERT_EQ(dynamic.size(), 1U);
    EXPECT_NEAR(dynamic[0].from, 737.473073, printed);
    EXPECT_FALSE(dynamic[0].to);
    EXPECT_FALSE(largest_plane_distance(rotor));
}

TEST(RigidRotorCriterion, SphericalRotorBands) {
    const auto rotor = rotor_with(1.0, 1.0);
    ASSERT_EQ(resonances(rotor).size(), 1U);
    const auto off_centre = static_balancing_bands(rotor, 0.1);
    ASSERT_EQ(off_centre.size(), 1U);
    EXPECT_EQ(off_centre[0].to, additional_speed(rotor, 0.1));
    const auto centre = static_balancing_bands(rotor, 0.0);
    ASSERT_EQ(centre.size(), 1U);
    EXPECT_FALSE(centre[0].to);
    EXPECT_TRUE(dynamic_balancing_bands(rotor).empty());
    EXPECT_FALSE(largest_plane_distance(rotor));
}

TEST(RigidRotorCriterion, ShortRotorBandsChangeAtTheLargestDistance) {
    const auto rotor = rotor_with(1.0, 1.6);
    const double distance = largest_plane_distance(rotor).value();
    EXPECT_NEAR(distance, 0.1, 1e-15);
    EXPECT_FALSE(static_balancing_bands(rotor, 0.99 * distance).front().to);
    EXPECT_FALSE(static_balancing_bands(rotor, -0.99 * distance).front().to);
    const auto outside = static_balancing_bands(rotor, 1.01 * distance);
    EXPECT_EQ(outside.front().to, additional_speed(rotor, 1.01 * distance));
    EXPECT_TRUE(dynamic_balancing_bands(rotor).empty());
}

TEST(RigidRotorCriterion, DeterminantVanishesAtTheResonances) {
    for (const double polar : {0.5, 3.0, 4.5}) {
        const auto rotor = rotor_with(3.0, polar);
        for (const double speed : resonances(rotor)) {
            const double slenderness = 3.0 - polar;
            const double scale = (rotor.k11 + rotor.mass * speed * speed) *
                                 (rotor.k33 + std::abs(slenderness) * speed * speed);
            EXPECT_NEAR(frequency_determinant(rotor, speed) / scale, 0.0, 1e-14);
        }
    }
}

TEST(RigidRotorCriterion, AdditionalSpeedLiesBetweenTheResonances) {
    const auto rotor = rotor_with(3.0, 1.0);
    const auto speeds = resonances(rotor);
    for (double z = -3.0; z <= 3.0; z += 0.01) {
        const double additional = additional_speed(rotor, z).value();
        EXPECT_GE(additional, speeds[0] * (1.0 - 1e-14));
        EXPECT_LE(additional, speeds[1] * (1.0 + 1e-14));
    }
}

// Every case of static balancing against the sign of the functional at random speeds and planes.
TEST(RigidRotorCriterion, StaticBandsAgreeWithTheFunctional) {
    std::mt19937 generator(3);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    int balanced = 0;
    for (int i = 0; i < 6000; ++i) {
        const double polar = i % 3 == 0 ? 2.0 : 1.0 + 2.5 * unit(generator);
        const auto rotor = rotor_with(2.0, polar);
        const double z = unit(generator) - 0.5;
        const double speed = 3000.0 * unit(generator);
        const auto bands = static_balancing_bands(rotor, z);
        if (at_an_end(bands, speed))
            continue;
        EXPECT_EQ(inside(bands, speed), balances_at(rotor, z, speed))
            << polar << ' ' << z << ' ' << speed;
        balanced += inside(bands, speed) ? 1 : 0;
    }
    EXPECT_GT(balanced, 1000);
    EXPECT_LT(balanced, 5000);
}

// Two planes, and three (excess): definite on every (I, S) they can make, which is every pair.
TEST(RigidRotorCriterion, DynamicBandsAgreeWithTheFunctional) {
    std::mt19937 generator(5);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int i = 0; i < 3000; ++i) {
        const auto rotor = rotor_with(2.0, 0.5 + 3.0 * unit(generator));
        const double speed = 3000.0 * unit(generator);
        const auto bands = dynamic_balancing_bands(rotor);
        if (at_an_end(bands, speed))
            continue;
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> form(
            Eigen::MatrixXd(criterion_matrix(rotor, speed)));
        EXPECT_EQ(inside(bands, speed), form.eigenvalues().maxCoeff() < 0.0);
    }
}

TEST(RigidRotorCriterion, ExcessPlanesLeaveTheFormSemidefinite) {
    const auto rotor = rotor_with(3.0, 1.0);
    Eigen::Matrix<double, 3, 2> planes;
    planes << -0.3, 1.0, 0.1, 1.0, 0.45, 1.0;
    const Eigen::Matrix3d form = planes * criterion_matrix(rotor, 900.0) * planes.transpose();
    const Eigen::Vector3d values =
        Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(Eigen::MatrixXd(form)).eigenvalues();
    EXPECT_LT(values[1], 0.0);
    EXPECT_NEAR(values[2] / values[0], 0.0, 1e-14);
}

/// With anisotropy the functional itself, of both principal planes, is negative in the bands alone.
TEST(RigidRotorCriterion, AnisotropyLeavesWhatBothPrincipalPlanesHave) {
    std::mt19937 engine(5);
    const auto random = [&engine](double a, double b) {
        return a + (b - a) * static_cast<double>(engine()) / 4294967296.0;
    };
    int balanced = 0;
    for (int i = 0; i < 2000; ++i) {
        TwoSupportRotor rotor = rotor_with(random(1, 3), random(0.5, 3));
        const double a = random(0, 0.9) * rotor.diametral_inertia;
        const TwoSupportRotor less = rotor_with(rotor.diametral_inertia - a, rotor.polar_inertia);
        const TwoSupportRotor more = rotor_with(rotor.diametral_inertia + a, rotor.polar_inertia);
        rotor.anisotropy = a;
        const double z = random(-0.4, 0.5);
        const double speed = random(50, 2000);
        const auto bands = static_balancing_bands(rotor, z);
        if (at_an_end(bands, speed))
            continue;
        const bool both = balances_at(less, z, speed) && balances_at(more, z, speed);
        EXPECT_EQ(inside(bands, speed), both);
        balanced += both ? 1 : 0;
        const bool dynamic =
            Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(criterion_matrix(less, speed))
                    .eigenvalues()
                    .maxCoeff() < 0 &&
            Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(criterion_matrix(more, speed))
                    .eigenvalues()
                    .maxCoeff() < 0;
        EXPECT_EQ(inside(dynamic_balancing_bands(rotor), speed), dynamic);
    }
    EXPECT_GT(balanced, 200);
}

} // namespace
} // namespace whirl::closed_form::rigid_rotor_criterion_test
