// Motions followed down to slow speeds as roots of Hill's series against the monodromy matrix there
// with as many steps as it needs, which shares nothing with it but the matrices of the rotor.

#include "periodic/slow_motions.h"

#include "periodic/monodromy.h"
#include "support/rotating_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

namespace {

using namespace whirl;

constexpr double from = 25;      // rad/s
constexpr double fastest = 1000; // of all motions as seen from the rotor, rad/s

/// Deflections and tilts at 200 to 650 rad/s; within half a turn the tilt's change by 5 %.
model::Rotor rotor(double c) {
    model::Rotor out;
    out.shaft = tests::weightless_rigid_shaft(1);
    out.discs = {tests::disc(0.5, 20, 0.8, 0.5)};
    out.anisotropies = {{"", 0.5, 0.08, 0}};
    out.bearings = {tests::bearing(0, 4e5, 6e5, 0, c), tests::bearing(1, 4e5, 6.5e5, 0, 1.5 * c)};
    return out;
}

int steps_at(double speed) { return static_cast<int>(fastest / speed * 2) + 16; }

/// How far a motion is from a copy of another, or of its conjugate, 1/s.
double apart(std::complex<double> a, std::complex<double> b, double speed) {
    double out = std::numeric_limits<double>::infinity();
    for (const std::complex<double> other : {b, std::conj(b)}) {
        const std::complex<double> off = a - other;
        out = std::min(
            out, std::abs(std::complex<double>(off.real(), std::remainder(off.imag(), 2 * speed))));
    }
    return out;
}

class SlowMotions : public testing::TestWithParam<double> {};

TEST_P(SlowMotions, AreThoseOfTheMonodromyMatrixEachOnce) {
    const model::Rotor scene = rotor(GetParam());
    const assembly::Discretization d(scene, 1);
    const periodic::System system(d, 0, {}, nullptr);
    periodic::SlowMotions slow([&system](double) -> const periodic::System & { return system; },
                               from,
                               periodic::floquet_series(system, from, steps_at(from), fastest));
    for (const double speed : {20.0, 7.3, 2.1, 1.1, 3.0}) {
        const auto found = slow.at(speed);
        ASSERT_TRUE(found) << speed;
        const auto matrix = periodic::floquet_motions(system, speed, steps_at(speed));
        ASSERT_EQ(2 * found->size(), matrix.size());
        for (const periodic::FloquetMotion &motion : matrix)
            EXPECT_EQ(std::count_if(found->begin(), found->end(),
                                    [&](const auto &other) {
                                        return apart(other.value, motion.value, speed) <
                                               1e-8 * speed + 10 * motion.noise;
                                    }),
                      1)
                << speed << ' ' << motion.value;
    }
}

INSTANTIATE_TEST_SUITE_P(Dampings, SlowMotions, testing::Values(0.0, 6.0));

/// Where the matrix has lost them in rounding: the sum of all exponents is the mean of the trace of
/// the first-order equations over a period (Liouville), here -trace(M^-1 D).
TEST(SlowMotionsOfADampedRotor, DieOutTogetherAsLiouvilleSays) {
    const model::Rotor scene = rotor(120);
    const assembly::Discretization d(scene, 1);
    const periodic::System system(d, 0, {}, nullptr);
    periodic::SlowMotions slow([&system](double) -> const periodic::System & { return system; },
                               from,
                               periodic::floquet_series(system, from, steps_at(from), fastest));
    const double speed = 1;
    const auto found = slow.at(speed);
    ASSERT_TRUE(found);
    ASSERT_EQ(found->size(), 4U);
    const periodic::System::Steady steady = system.steady(speed);
    const double trace = (steady.M.inverse() * steady.D).trace();
    double sum = 0;
    for (const auto &motion : *found)
        sum += 2 * motion.value.real();
    EXPECT_NEAR(sum, -trace, 1e-9 * trace);
}

} // namespace
