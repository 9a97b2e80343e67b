#include "simulation/spin.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace whirl::simulation {
namespace {

TEST(Spin, ConstantSpeed) {
    const Spin spin(12.5);
    EXPECT_TRUE(spin.jumps().empty());
    EXPECT_DOUBLE_EQ(spin.turned(4), 50);
    EXPECT_EQ(spin.at(4, 4).speed, 12.5);
    EXPECT_EQ(spin.at(4, 4).acceleration, 0);
    EXPECT_EQ(spin.fastest(9), 12.5);
}

// Speed 2 until t = 1, up to 6 at t = 3, down to 1 at t = 4, then constant.
TEST(Spin, RunUp) {
    const Spin spin({{1, 2}, {3, 6}, {4, 1}});
    const std::vector<double> jumps{1, 3, 4};
    EXPECT_EQ(spin.jumps(), jumps);
    EXPECT_DOUBLE_EQ(spin.turned(1), 2);
    EXPECT_DOUBLE_EQ(spin.turned(3), 2 + 8);
    EXPECT_DOUBLE_EQ(spin.turned(4), 2 + 8 + 3.5);
    EXPECT_DOUBLE_EQ(spin.turned(10), 2 + 8 + 3.5 + 6);
    EXPECT_DOUBLE_EQ(spin.at(2, 2).speed, 4);
    EXPECT_DOUBLE_EQ(spin.at(2, 2).acceleration, 2);
    EXPECT_DOUBLE_EQ(spin.at(3, 2.5).acceleration, 2); // at a jump: of the piece asked for
    EXPECT_DOUBLE_EQ(spin.at(3, 3.5).acceleration, -5);
    EXPECT_DOUBLE_EQ(spin.at(3, 2.5).speed, spin.at(3, 3.5).speed);
    EXPECT_DOUBLE_EQ(spin.fastest(2), 4);
    EXPECT_DOUBLE_EQ(spin.fastest(10), 6);
}

// The angle differs from the whole one by full turns only.
TEST(Spin, AngleLeavesOutWholeTurns) {
    const Spin spin({{0, 0}, {100, 300}});
    for (const double t : {3.0, 50.0, 99.0, 101.0, 1e4}) {
        const double turns = (spin.at(t, t).angle - spin.turned(t)) / (2 * std::numbers::pi);
        EXPECT_NEAR(turns, std::round(turns), 1e-9) << t;
    }
}

} // namespace
} // namespace whirl::simulation
