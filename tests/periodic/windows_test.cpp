// The matrix of half a turn by maps of ever wider windows against the product of all its steps, and
// what it has to conserve however many these are.

#include "periodic/monodromy.h"
#include "periodic/step_maps.h"
#include "support/rotating_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

namespace windows_test {

using namespace whirl;

/// An elastic rotor of two stiffnesses, motions from some 200 rad/s on.
model::Rotor rotor(double c) {
    model::Rotor out;
    out.shaft.segments = {tests::cylinder(0.4, 0.05, 1), tests::cylinder(0.6, 0.05, 2)};
    out.shaft.segments[1].asymmetry = 0.1;
    out.shaft.order = 2;
    out.discs = {tests::disc(0.4, 12, 0.12, 0.2)};
    out.anisotropies = {{"", 0.4, 0.03, 0.3}};
    out.bearings = {tests::bearing(0, 8e5, 5e5, 0, c), tests::bearing(1, 9e5, 6e5, 0, c)};
    return out;
}

constexpr double fastest = 1500; // of the motions looked at, rad/s

int steps_at(double speed) { return static_cast<int>(fastest / speed * 2) + 16; }

double apart(std::complex<double> a, std::complex<double> b, double speed) {
    const std::complex<double> off = a - b;
    return std::abs(std::complex<double>(off.real(), std::remainder(off.imag(), 2 * speed)));
}

TEST(Windows, GiveTheMotionsOfTheProductOfAllSteps) {
    for (const double c : {0.0, 40.0}) {
        const model::Rotor scene = rotor(c);
        const assembly::Discretization d(scene, 2);
        const periodic::System system(d, 0, {}, nullptr);
        for (const double speed : {6.0, -2.0}) {
            const int steps = steps_at(std::abs(speed));
            ASSERT_TRUE(periodic::half_turn_by_windows(system, speed, steps)) << speed;
            const auto found = periodic::floquet_motions(system, speed, steps);
            const auto all_steps = periodic::floquet_series(system, speed, steps, fastest);
            EXPECT_GE(all_steps.size(), 4U);
            for (const periodic::FloquetSeries &one : all_steps) {
                double nearest = std::numeric_limits<double>::infinity();
                for (const periodic::FloquetMotion &motion : found)
                    nearest = std::min(nearest, apart(motion.value, one.value, speed));
                EXPECT_LT(nearest, 1e-10 * std::abs(speed) + 10 * one.noise) << c << ' ' << speed;
            }
        }
    }
}

/// Of so many products next to nothing may be left over.
TEST(Windows, ConserveTheEnergyOverTensOfThousandsOfSteps) {
    const model::Rotor scene = rotor(0);
    const assembly::Discretization d(scene, 2);
    const periodic::System system(d, 0, {}, nullptr);
    for (const double speed : {1.0, 0.1, 0.03}) {
        int slow = 0;
        for (const auto &motion : periodic::floquet_motions(system, speed, steps_at(speed)))
            if (motion.frequency < fastest / 2) {
                ++slow;
                EXPECT_LT(std::abs(motion.value.real()), motion.noise + 1e-11 * speed) << speed;
                EXPECT_LT(motion.noise, 1e-14 * fastest) << speed;
            }
        EXPECT_GE(slow, 8) << speed;
    }
}

TEST(Windows, AreNotForFewSteps) {
    const model::Rotor scene = rotor(0);
    const assembly::Discretization d(scene, 2);
    const periodic::System system(d, 0, {}, nullptr);
    EXPECT_FALSE(periodic::half_turn_by_windows(system, 100, 40));
}

} // namespace windows_test
