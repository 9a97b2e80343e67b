// Rows of rigid-limit for balancers that are free: published numbers of rigid rotors, approached as
// the shaft stiffens.

#include "analyses/rigid_limit.h"
#include "closed_form/pendulum_balancer.h"
#include "support/balancer_scenes.h"
#include "verification/two_plane_rotor.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace whirl::analyses {
namespace {

results::RigidLimitRow row_named(const results::RigidLimitResult &result, const std::string &name) {
    for (const results::RigidLimitRow &row : result.rows)
        if (row.quantity.text() == name)
            return row;
    ADD_FAILURE() << "no row " << name;
    return {};
}

/// Differences fall in proportion to the compliance of the shaft, whose rotor is the rigid one in
/// the end.
void expect_first_order(const results::RigidLimitRow &row) {
    ASSERT_TRUE(row.rate) << row.quantity;
    EXPECT_NEAR(*row.rate, -1, 0.02) << row.quantity;
    EXPECT_LT(*row.relative_difference.back(), 1e-4) << row.quantity;
    ASSERT_TRUE(row.rigid);
    EXPECT_NEAR(*row.rigid, row.closed_form, 1e-9 * row.closed_form);
    EXPECT_FALSE(row.speed) << "no speed that the 1 % are of";
}

// Rodrigues et al. (2008): eps = chi = 0.005, m = c_b = 0.01: the limit cycle at 3.386 is born at
// 3.387, four digits.
TEST(RigidLimitFree, BandsOfFreeBallsTendToThoseOfTheRigidRotor) {
    model::Case scene = tests::rotor_with({0.005, 0.005, 1}, 0.01, 0.01);
    scene.rotor.shaft.rigid = false;
    scene.rotor.shaft.segments[0].material.E *= 10;
    scene.rotor.shaft.segments[0].material.G *= 10;
    scene.speeds = model::SpeedRange{3, 4, 11};
    const results::RigidLimitResult result = rigid_limit(scene);
    const results::RigidLimitRow row =
        row_named(result, "end 1 of the unstable speeds with free balls");
    EXPECT_NEAR(row.closed_form, 3.387, 6e-4);
    expect_first_order(row);
}

// The rotor of the first figure: the efficiency is that of the planar closed form.
TEST(RigidLimitFree, EfficiencyOfPendulumsTendsToThePlanarOne) {
    model::Case scene = tests::pendulum_rotor_scene(1, 1.0, 0.5, 0.02);
    scene.rotor.shaft.rigid = false;
    for (model::Segment &segment : scene.rotor.shaft.segments) {
        segment.material.E *= 100;
        segment.material.G *= 100;
    }
    scene.speeds = model::SpeedRange{150, 250, 2};
    const results::RigidLimitResult result = rigid_limit(scene);
    closed_form::PendulumRotor planar;
    planar.mass_ratio = 2.0 / 9;
    planar.pivot_ratio = 0.02 / 0.18;
    planar.external_damping = 1;
    planar.hinge_damping = 0.5;
    planar.imbalance = 0.02 / (2 * 0.18);
    std::vector<double> expected;
    for (const double ratio : {1.5, 2.5})
        expected.push_back(closed_form::exact_efficiency(
            planar, closed_form::steady_motions(planar, ratio).front(), ratio));
    std::size_t rows = 0;
    for (const results::RigidLimitRow &row : result.rows)
        if (row.of == model::Quantity::number) {
            ASSERT_LT(rows, expected.size());
            EXPECT_NEAR(row.closed_form, expected[rows], 1e-6) << rows;
            expect_first_order(row);
            ++rows;
        }
    EXPECT_EQ(rows, 2U);
}

TEST(RigidLimitFree, WithoutARangeOfSpeedsNothingIsAsked) {
    model::Case scene = tests::rotor_with({0.005, 0.005, 1}, 0.01, 0.01);
    scene.rotor.shaft.rigid = false;
    scene.speeds = model::SpeedRange{3, 3, 1};
    for (const results::RigidLimitRow &row : rigid_limit(scene).rows)
        EXPECT_NE(row.quantity.text(), "end 1 of the unstable speeds with free balls");
}

} // namespace
} // namespace whirl::analyses
