#include "ends/band_ends.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <stdexcept>
#include <vector>

namespace whirl::ends {
namespace {

constexpr double noise = 1e-11;
constexpr double stops = 391.07; ///< of one of the motions that grow, rad/s

stability::Motion motion(double real, double imaginary) {
    stability::Motion out;
    out.value = {real, imaginary};
    out.state = Eigen::VectorXcd::Ones(1);
    out.noise = noise;
    return out;
}

/// Balls at a heavy spot: two motions grow with the fourth power of the speed, one of them up to a
/// speed; a third dies out. Motions over half a turn cannot be had right beside rest.
std::vector<stability::Motion> balls_at(double speed) {
    const double size = std::abs(speed);
    if (size > 0 && size < 1e-3)
        throw std::logic_error("asked for motions right beside rest");
    const double fourth = 5e-9 * std::pow(size, 4);
    return {motion(fourth, 0), motion(0.3 * fourth * (1 - size / stops), 0), motion(-6, 2)};
}

TEST(MultiplierEnds, GrowthThatSinksBelowTheNoiseTowardsRestHasNoEndThere) {
    for (const std::vector<double> &speeds :
         {std::vector<double>{0, 100, 200, 300, 400, 500}, {0, 500}, {0.05, 500}, {2, 7, 500}}) {
        const results::Interval band{speeds.front(), speeds.back()};
        const EndsFound found = multiplier_ends(balls_at, speeds, {band});
        ASSERT_EQ(found.ends.size(), 1U) << "from " << speeds.front();
        EXPECT_NEAR(found.ends[0].speed, stops, 1e-9 * stops);
        EXPECT_EQ(found.ends[0].growing_below, 2);
        EXPECT_EQ(found.ends[0].growing_above, 1);
        EXPECT_EQ(found.growing_from, 2);
    }
}

TEST(MultiplierEnds, SpinningTheOtherWayToo) {
    const EndsFound found = multiplier_ends(balls_at, {-500, -200, 0}, {{-500, 0}});
    ASSERT_EQ(found.ends.size(), 1U);
    EXPECT_NEAR(found.ends[0].speed, -stops, 1e-9 * stops);
    EXPECT_EQ(found.ends[0].growing_below, 1);
    EXPECT_EQ(found.ends[0].growing_above, 2);
    EXPECT_EQ(found.growing_from, 1);
}

/// Two motions without damping meet: growth rises like a root, from nothing.
std::vector<stability::Motion> meeting_at(double speed) {
    constexpr double from = 2;
    const double growth = speed > from ? 1e-3 * std::sqrt(speed - from) : 0;
    return {motion(growth, 1), motion(-growth, 1)};
}

TEST(MultiplierEnds, AnEndAtASlowSpeedIsOneWhereNothingGrowsBeyond) {
    const EndsFound found = multiplier_ends(meeting_at, {0, 10}, {});
    ASSERT_EQ(found.ends.size(), 1U);
    EXPECT_NEAR(found.ends[0].speed, 2, 1e-9);
    EXPECT_EQ(found.growing_from, 0);
}

} // namespace
} // namespace whirl::ends
