// Motions that die out by many powers of ten within half a turn: against constant coefficients
// where the supports are the same from every direction, against the matrix of half a turn where
// nothing is drowned in it, and each as a root of Hill's series of the whole rotor.

#include "periodic/monodromy.h"
#include "periodic/triangular_turn.h"
#include "periodic/whole_root.h"
#include "support/rotating_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <vector>

namespace triangular_turn_test {

using namespace whirl;
using Complex = std::complex<double>;

model::Rotor rotor(double kyy, double c) {
    model::Rotor out;
    out.shaft.segments = {tests::cylinder(0.4, 0.05, 1), tests::cylinder(0.6, 0.05, 2)};
    out.shaft.segments[1].asymmetry = 0.1;
    out.shaft.order = 2;
    out.discs = {tests::disc(0.4, 12, 0.12, 0.2)};
    out.bearings = {tests::bearing(0, 8e5, kyy, 0, c), tests::bearing(1, 9e5, kyy, 0, c)};
    return out;
}

constexpr double fastest = 2500; // of the motions looked at, rad/s

/// For the steps to be told apart at once or anew with all.
constexpr int columns = 24;

int steps_at(double speed) { return static_cast<int>(fastest / speed * 3) + 24; }

/// Logarithm of what half a turn leaves of the motions looked at.
double spread_at(const periodic::System &system, double speed) {
    double damping = 0;
    for (const periodic::FloquetMotion &motion : periodic::steady_motions(system, speed))
        if (std::abs(motion.value) < fastest)
            damping = std::max(damping, -motion.value.real());
    return damping * std::acos(-1.0) / speed;
}

double apart(Complex a, Complex b, double speed) {
    const Complex off = a - b;
    const double turn = std::remainder(off.imag(), 2 * speed);
    return std::abs(Complex(off.real(), turn));
}

double nearest(Complex value, const std::vector<periodic::FloquetSeries> &all, double speed) {
    double out = std::numeric_limits<double>::infinity();
    for (const periodic::FloquetSeries &one : all)
        out = std::min(
            {out, apart(value, one.value, speed), apart(std::conj(value), one.value, speed)});
    return out;
}

TEST(TriangularTurn, FindsAllMotionsOfConstantCoefficients) {
    const model::Rotor scene = rotor(8.5e5, 6000);
    model::Rotor same = scene;
    for (model::Bearing &bearing : same.bearings)
        bearing.rows[0].k(1, 1) = bearing.rows[0].k(0, 0);
    const assembly::Discretization d(same, 2);
    const periodic::System system(d, 0, {}, nullptr);
    for (const double speed : {12.0, 60.0}) {
        const double spread = spread_at(system, speed);
        EXPECT_GT(spread, 25) << speed; // far beyond what rounding leaves
        const auto found =
            periodic::damped_series(system, speed, steps_at(speed), spread, columns, fastest);
        ASSERT_TRUE(found) << speed;
        int met = 0;
        for (const periodic::FloquetMotion &motion : periodic::steady_motions(system, speed)) {
            if (std::abs(motion.value) > 0.7 * fastest)
                continue;
            ++met;
            // Steps are exact to 2e-12 each, and groups of them to their rounding.
            EXPECT_LT(nearest(motion.value, *found, speed), 1e-8 * fastest)
                << speed << ' ' << motion.value;
        }
        EXPECT_GE(met, 8) << speed;
    }
}

TEST(TriangularTurn, AgreesWithTheMatrixOfHalfATurn) {
    const model::Rotor scene = rotor(5e5, 300);
    const assembly::Discretization d(scene, 2);
    const periodic::System system(d, 0, {}, nullptr);
    for (const double speed : {150.0, -400.0}) {
        const double size = std::abs(speed);
        const double spread = spread_at(system, size);
        const auto all = periodic::floquet_series(system, speed, 2 * steps_at(size), fastest);
        const auto found =
            periodic::damped_series(system, speed, 2 * steps_at(size), spread, columns, fastest);
        ASSERT_TRUE(found) << speed;
        EXPECT_GE(all.size(), 6U);
        EXPECT_EQ(all.size(), found->size());
        for (const periodic::FloquetSeries &one : all)
            EXPECT_LT(nearest(one.value, *found, speed), 1e-9 * size + 10 * one.noise)
                << speed << ' ' << one.value;
    }
}

TEST(TriangularTurn, GivesRootsOfTheSeriesOfTheWholeRotor) {
    const model::Rotor scene = rotor(5e5, 6000);
    const assembly::Discretization d(scene, 2);
    const periodic::System system(d, 0, {}, nullptr);
    const periodic::WholeRotor whole(d, {});
    for (const double speed : {20.0, 50.0}) {
        const double spread = spread_at(system, speed);
        EXPECT_GT(spread, 30) << speed;
        const auto found =
            periodic::damped_series(system, speed, steps_at(speed), spread, columns, fastest);
        ASSERT_TRUE(found) << speed;
        int met = 0;
        for (const periodic::FloquetSeries &one : *found) {
            if (one.value.imag() == 0) // its place among the terms is not that of a whirl
                continue;
            const auto root = whole.next_to(speed, one.value, 0, one.terms);
            ASSERT_TRUE(root) << speed << ' ' << one.value;
            ++met;
            EXPECT_LT(std::abs(root->value - one.value), 1e-8 * fastest)
                << speed << ' ' << one.value;
        }
        EXPECT_GE(met, 5) << speed;
    }
}

} // namespace triangular_turn_test
