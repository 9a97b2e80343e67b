#include "closed_form/jeffcott.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace whirl::closed_form {
namespace {

JeffcottRotor example() { return {2.0, 8e4, 20.0, 5.0, 1e-4}; }

TEST(Jeffcott, CriticalSpeed) { EXPECT_DOUBLE_EQ(jeffcott_critical_speed(example()), 200.0); }

TEST(Jeffcott, ResponseLagsByARightAngleAtTheCriticalSpeed) {
    const auto response = jeffcott_response(example(), 200.0);
    // e m Omega^2 / (Omega c_e) = 1e-4 * 2 * 200 / 20.
    EXPECT_NEAR(std::abs(response), 2e-3, 1e-17);
    EXPECT_NEAR(std::arg(response), -std::numbers::pi / 2.0, 1e-14);
}

TEST(Jeffcott, CentresItselfAtHighSpeed) {
    const auto response = jeffcott_response(example(), 2e6);
    EXPECT_NEAR(response.real(), -1e-4, 1e-11);
}

TEST(Jeffcott, UndampedResponseBelowCritical) {
    auto rotor = example();
    rotor.external_damping = 0.0;
    // e r^2 / (1 - r^2) with r = 1/2.
    EXPECT_NEAR(std::abs(jeffcott_response(rotor, 100.0)), 1e-4 / 3.0, 1e-18);
}

TEST(Jeffcott, ForwardWhirlTurnsUnstableAtTheThreshold) {
    const auto rotor = example();
    const double threshold = internal_damping_threshold(rotor);
    EXPECT_DOUBLE_EQ(threshold, 1000.0);
    EXPECT_LT(jeffcott_roots(rotor, 0.999 * threshold).forward.real(), 0.0);
    EXPECT_GT(jeffcott_roots(rotor, 1.001 * threshold).forward.real(), 0.0);
    EXPECT_NEAR(jeffcott_roots(rotor, threshold).forward.real(), 0.0, 1e-12);
    EXPECT_NEAR(jeffcott_roots(rotor, threshold).forward.imag(), 200.0, 1e-10);
    EXPECT_LT(jeffcott_roots(rotor, 2.0 * threshold).backward.real(), 0.0);
}

TEST(Jeffcott, NoThresholdWithoutInternalDamping) {
    auto rotor = example();
    rotor.internal_damping = 0.0;
    EXPECT_TRUE(std::isinf(internal_damping_threshold(rotor)));
}

TEST(Jeffcott, RootsSatisfyTheCharacteristicEquation) {
    const auto rotor = example();
    const double speed = 1300.0;
    const auto roots = jeffcott_roots(rotor, speed);
    for (const auto root : {roots.forward, roots.backward}) {
        const auto residual =
            rotor.mass * root * root + (rotor.external_damping + rotor.internal_damping) * root +
            std::complex<double>(rotor.stiffness, -speed * rotor.internal_damping);
        EXPECT_LT(std::abs(residual) / rotor.stiffness, 1e-14);
    }
    EXPECT_GT(roots.forward.imag(), 0.0);
    EXPECT_LT(roots.backward.imag(), 0.0);
}

} // namespace
} // namespace whirl::closed_form
