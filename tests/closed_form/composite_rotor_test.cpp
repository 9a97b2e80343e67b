#include "closed_form/composite_rotor.h"

#include "closed_form/balanced_position.h"
#include "closed_form/two_balls.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace whirl::closed_form {
namespace {

/// Base set of the paper: n m = 4 kg at 0.2 m, m0 = 2 kg at 0.2 m.
const BareRotor base_rotor{57.83, 0.413, 0.289, 0.1};
const BallSet base_balls{2, 2.0, 0.2, 0.0};
const PlaneImbalance base_imbalance{0.4, 2.0};

// Printed with three decimals (C_r/A_r with one).
TEST(CompositeRotor, NumbersOfTheBaseSet) {
    const auto rotor = composite_rotor(base_rotor, base_balls, base_imbalance, 0.5);
    const double mean = rotor.mean_inertia();
    EXPECT_NEAR(4.0 / rotor.mass, 0.063, 0.5e-3);
    EXPECT_NEAR(rotor.ball_inertia / mean, 0.272, 0.5e-3);
    EXPECT_NEAR(rotor.imbalance_inertia / mean, 0.136, 0.5e-3);
    EXPECT_NEAR(rotor.polar_inertia / mean, 0.901, 0.5e-3);
    EXPECT_NEAR(base_rotor.polar_inertia / base_rotor.diametral_inertia, 0.7, 0.5e-1);
}

TEST(CompositeRotor, InertiasFollowFromTheBodiesDirectly) {
    const std::vector<double> angles{1.9, -2.4, 2.7};
    const BallSet balls{3, 1.1, 0.23, 0.0};
    const PlaneImbalance imbalance{0.3, 1.7};
    const auto rotor = composite_rotor(base_rotor, balls, imbalance, second_harmonic(angles));

    const double added = 1.7 + 3.3;
    EXPECT_NEAR(57.83 * rotor.rotor_position + added * rotor.balancer_position, 0.0, 1e-14);
    EXPECT_NEAR(rotor.balancer_position - rotor.rotor_position, 0.1, 1e-16);

    const auto about_centre = [&](double axis) {
        double inertia = 0.413 + 57.83 * std::pow(rotor.rotor_position, 2);
        const auto add = [&](double mass, double radius, double angle) {
            inertia += mass * (std::pow(rotor.balancer_position, 2) +
                               std::pow(radius * std::sin(angle - axis), 2));
        };
        add(1.7, 0.3 / 1.7, 0.0);
        for (const double angle : angles)
            add(1.1, 0.23, angle);
        return inertia;
    };
    for (double axis = 0.0; axis < 3.2; axis += 0.37)
        EXPECT_NEAR(rotor.inertia_about(axis), about_centre(axis), 1e-14);

    const double size = std::abs(rotor.anisotropy());
    const double direction = std::arg(rotor.anisotropy()) / 2.0; // of the smaller inertia
    const double mean = rotor.mean_inertia();
    EXPECT_NEAR(about_centre(direction), mean - size, 1e-14);
    EXPECT_NEAR(about_centre(direction + std::numbers::pi / 2.0), mean + size, 1e-14);
    EXPECT_NEAR(about_centre(direction + 1e-4), mean - size, 1e-8);
    EXPECT_GT(2.0 * size, 0.01);
}

TEST(CompositeRotor, PrincipalValuesForRealHarmonic) {
    const double D = two_ball_second_harmonic(1.6);
    const auto rotor = composite_rotor(base_rotor, base_balls, base_imbalance, D);
    EXPECT_NEAR(rotor.inertia_about(0.0), rotor.base_inertia + 0.5 * 0.16 * (1.0 - D), 1e-15);
    EXPECT_NEAR(rotor.inertia_about(std::numbers::pi / 2.0),
                rotor.base_inertia + 0.08 + 0.5 * 0.16 * (1.0 + D), 1e-15);
}

// A_m0 + A_m D_c = A_m0 (1 + E (2/E^2 - 1)) = 0 at E = 2: isotropic; the unsigned form misses it.
TEST(CompositeRotor, TwoBallsAtCapacityTwoAreIsotropic) {
    const auto rotor =
        composite_rotor(base_rotor, base_balls, base_imbalance, two_ball_second_harmonic(2.0));
    EXPECT_NEAR(std::abs(rotor.anisotropy()), 0.0, 1e-17);
    EXPECT_NEAR(std::abs(rotor.with_unsigned_harmonic().anisotropy()), 0.08, 1e-16);
}

TEST(CompositeRotor, OwnEccentricityAddsNothing) {
    const auto rotor = composite_rotor(base_rotor, base_balls, PlaneImbalance{0.4, 0.0}, 0.5);
    EXPECT_DOUBLE_EQ(rotor.mass, 61.83);
    EXPECT_EQ(rotor.imbalance_inertia, 0.0);
}

} // namespace
} // namespace whirl::closed_form
