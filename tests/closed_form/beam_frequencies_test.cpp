#include "closed_form/beam_frequencies.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace whirl::closed_form::beam_frequencies_test {
namespace {

constexpr double hertz = 2.0 * std::numbers::pi;
/// Half a unit of the last printed digit, in Hz.
constexpr double printed = 0.5e-4;

UniformShaft reference_shaft() { return circular_shaft(0.9, 0.025, 0.0, 2e11, 7800.0); }

// code_aster sdll141a, from Gibert: without the rotary inertia of the sections.
TEST(BeamFrequencies, MatchesGibertAtRest) {
    const double expected[] = {122.7475, 490.9899, 1104.7273, 1963.9596};
    for (int mode = 1; mode <= 4; ++mode) {
        const auto pair = euler_whirl(reference_shaft(), mode, 0.0, RotaryInertia::neglected);
        EXPECT_NEAR(pair.forward / hertz, expected[mode - 1], printed);
        EXPECT_DOUBLE_EQ(pair.forward, pair.backward);
    }
}

TEST(BeamFrequencies, MatchesGibertAtTenThousandRadiansPerSecond) {
    const double backward[] = {119.7548, 479.0191, 1077.7931, 1916.0765};
    const double forward[] = {125.8150, 503.2598, 1132.3346, 2013.0393};
    for (int mode = 1; mode <= 4; ++mode) {
        const auto pair = euler_whirl(reference_shaft(), mode, 1e4, RotaryInertia::neglected);
        EXPECT_NEAR(pair.backward / hertz, backward[mode - 1], printed);
        EXPECT_NEAR(pair.forward / hertz, forward[mode - 1], printed);
    }
}

TEST(BeamFrequencies, MatchesIndependentValuesWithRotaryInertia) {
    const double at_rest[] = {122.6308, 489.1310, 1095.3826, 1934.7133};
    const double backward[] = {119.6438, 477.2501, 1068.8993};
    const double forward[] = {125.6924, 501.3076, 1122.5220};
    for (int mode = 1; mode <= 4; ++mode) {
        const auto pair = euler_whirl(reference_shaft(), mode, 0.0, RotaryInertia::kept);
        EXPECT_NEAR(pair.forward / hertz, at_rest[mode - 1], printed);
    }
    for (int mode = 1; mode <= 3; ++mode) {
        const auto pair = euler_whirl(reference_shaft(), mode, 1e4, RotaryInertia::kept);
        EXPECT_NEAR(pair.backward / hertz, backward[mode - 1], printed);
        EXPECT_NEAR(pair.forward / hertz, forward[mode - 1], printed);
    }
}

TEST(BeamFrequencies, SpinningBackwardSwapsTheSenses) {
    const auto plus = euler_whirl(reference_shaft(), 2, 3e3, RotaryInertia::kept);
    const auto minus = euler_whirl(reference_shaft(), 2, -3e3, RotaryInertia::kept);
    EXPECT_DOUBLE_EQ(plus.forward, minus.backward);
    EXPECT_DOUBLE_EQ(plus.backward, minus.forward);
}

TEST(BeamFrequencies, CriticalSpeedIsWhereForwardWhirlEqualsSpin) {
    const double speed = euler_forward_critical(reference_shaft(), 3, RotaryInertia::kept);
    const auto pair = euler_whirl(reference_shaft(), 3, speed, RotaryInertia::kept);
    EXPECT_NEAR(pair.forward / speed, 1.0, 1e-14);
}

TEST(BeamFrequencies, NoCriticalSpeedWhereTheGyroscopicMomentIsTooLarge) {
    // rho A <= rho I k^2 for a thick shaft and a short wave.
    const auto thick = circular_shaft(0.1, 0.05, 0.0, 2e11, 7800.0);
    EXPECT_EQ(euler_forward_critical(thick, 5, RotaryInertia::kept), 0.0);
}

TEST(BeamFrequencies, HollowShaftSection) {
    const auto shaft = circular_shaft(1.0, 0.05, 0.03, 2e11, 7800.0);
    EXPECT_NEAR(shaft.area, 5.026548245743669e-3, 1e-17);
    EXPECT_NEAR(shaft.second_moment, 4.272566008882119e-6, 1e-20);
}

TEST(BeamFrequencies, TimoshenkoRootsSatisfyTheFrequencyEquation) {
    auto shaft = reference_shaft();
    shaft.shear_modulus = 2e11 / 2.6;
    shaft.shear_coefficient = 0.9;
    const double omega = 8e3;
    for (int mode = 1; mode <= 6; ++mode) {
        const double k = mode * std::numbers::pi / shaft.length;
        const double kga = shaft.shear_coefficient * shaft.shear_modulus * shaft.area;
        const double rho_i = shaft.density * shaft.second_moment;
        for (const double w : timoshenko_whirl(shaft, mode, omega)) {
            const double translation = -shaft.density * shaft.area * w * w + kga * k * k;
            const double rotation = -rho_i * w * w + 2.0 * rho_i * omega * w +
                                    shaft.young_modulus * shaft.second_moment * k * k + kga;
            // Roots of a 4 x 4 symmetric matrix: backward error of some units of rounding.
            const double scale = std::abs(translation * rotation) + kga * k * kga * k;
            EXPECT_NEAR((translation * rotation - kga * k * kga * k) / scale, 0.0, 1e-11);
        }
    }
}

TEST(BeamFrequencies, TimoshenkoTendsToRayleighAsShearStiffens) {
    auto shaft = reference_shaft();
    shaft.shear_modulus = 1e16;
    const auto rayleigh = euler_whirl(shaft, 2, 5e3, RotaryInertia::kept);
    const auto roots = timoshenko_whirl(shaft, 2, 5e3);
    // Relative difference is of the order E I k^2 / (kappa G A) = 1.5e-7 here.
    EXPECT_NEAR(-roots[1] / rayleigh.backward, 1.0, 3e-7);
    EXPECT_NEAR(roots[2] / rayleigh.forward, 1.0, 3e-7);
}

} // namespace
} // namespace whirl::closed_form::beam_frequencies_test
