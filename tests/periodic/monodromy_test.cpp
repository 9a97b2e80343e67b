// The monodromy matrix in rotating axes against closed forms, and against SciPy's integration of
// the same rotor in axes that do not turn (tilt_multipliers.py).

#include "periodic/monodromy.h"

#include "analyses/stability.h"
#include "stability/hill/hill_solver.h"
#include "stability/unstable_bands.h"
#include "support/looked_at.h"
#include "support/rotating_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace {

using namespace whirl;
using Values = std::vector<std::complex<double>>;

/// A rigid rotor that is held alike at both ends; the tilt has no part in the deflection.
model::Rotor rigid_rotor(double Id, double Ip, double dI, double kxx, double kyy, double c) {
    model::Rotor rotor;
    rotor.shaft = tests::weightless_rigid_shaft(1);
    rotor.discs = {tests::disc(0.5, 20, Id, Ip)};
    if (dI != 0)
        rotor.anisotropies = {{"", 0.5, dI, 0}};
    rotor.bearings = {tests::bearing(0, kxx, kyy, 0, c), tests::bearing(1, kxx, kyy, 0, c)};
    return rotor;
}

/// Roots of m l^2 + c l + k.
void add_roots(Values &to, double m, double c, double k) {
    const std::complex<double> root = std::sqrt(std::complex<double>(c * c - 4 * m * k));
    to.push_back((-c + root) / (2 * m));
    to.push_back((-c - root) / (2 * m));
}

double farthest(const Values &some, const Values &others) {
    double worst = 0;
    for (const auto &value : some) {
        double nearest = 1e300;
        for (const auto &other : others)
            nearest = std::min(nearest, std::abs(value - other));
        worst = std::max(worst, nearest);
    }
    return worst;
}

// Without polar inertia x and y do not know of each other in the fixed axes, however the bearings
// differ: closed forms. After half a turn the rotating axes point the other way.
TEST(Monodromy, OfARotorWithoutGyroscopicEffectInClosedForm) {
    const model::Rotor rotor = rigid_rotor(0.8, 0, 0, 4e5, 7e5, 30);
    const assembly::Discretization d(rotor, 1);
    const periodic::System system(d, 0, {}, nullptr);
    Values exponents;
    for (const double k : {4e5, 7e5}) {
        add_roots(exponents, 20, 2 * 30, 2 * k);
        add_roots(exponents, 0.8, 30 * 0.5, k * 0.5);
    }
    for (const double speed : {-300.0, 20.0, 170.0, 900.0, 6000.0}) {
        const double period = std::numbers::pi / std::abs(speed);
        Values exact;
        for (const auto &l : exponents)
            exact.push_back(-std::exp(l * period));
        const int steps = 8 + static_cast<int>(std::ceil(1000 * period));
        Values found;
        for (const auto &motion : periodic::floquet_motions(system, speed, steps))
            found.push_back(std::exp(motion.value * period));
        ASSERT_EQ(found.size(), exact.size());
        // Rounding of some dozens of steps, each known to 1e-13.
        EXPECT_LT(std::max(farthest(exact, found), farthest(found, exact)), 1e-11) << speed;
    }
}

TEST(Monodromy, AtRestTheSupportsStandAsTheyAre) {
    const model::Rotor rotor = rigid_rotor(0.8, 0.5, 0.1, 4e5, 7e5, 30);
    const assembly::Discretization d(rotor, 1);
    const periodic::System system(d, 0, {}, nullptr);
    Values exact;
    for (const double k : {4e5, 7e5})
        add_roots(exact, 20, 2 * 30, 2 * k);
    add_roots(exact, 0.8 + 0.1, 30 * 0.5, 4e5 * 0.5); // the slope about the axis of larger inertia
    add_roots(exact, 0.8 - 0.1, 30 * 0.5, 7e5 * 0.5);
    Values found;
    for (const auto &motion : periodic::steady_motions(system, 0))
        found.push_back(motion.value);
    EXPECT_LT(farthest(exact, found), 1e-8);
}

// Bearings like those that hold motions far too fast for the steps: these die out, slow ones are as
// exact as without them.
TEST(Monodromy, MotionsTooFastForTheStepsDieOut) {
    model::Rotor rotor = rigid_rotor(0.8, 0, 0, 4e5, 7e5, 0);
    for (model::Bearing &bearing : rotor.bearings) { // tilt: about 1e6 rad/s
        bearing.rows[0].kt(0, 0) = 4e11;
        bearing.rows[0].kt(1, 1) = 4e11;
    }
    const assembly::Discretization d(rotor, 1);
    const periodic::System system(d, 0, {}, nullptr);
    const double speed = 170;
    const double period = std::numbers::pi / speed;
    Values slow;
    for (const double k : {4e5, 7e5})
        add_roots(slow, 20, 0, 2 * k);
    for (auto &value : slow)
        value = -std::exp(value * period);
    Values found;
    for (const auto &motion : periodic::floquet_motions(system, speed, 12)) {
        found.push_back(std::exp(motion.value * period));
        EXPECT_LT(std::abs(found.back()), 1 + 1e-10);
    }
    EXPECT_LT(farthest(slow, found), 1e-10);
}

struct Growth {
    double speed, of_tilt; ///< rad/s, 1/s
};

/// Of the tilt; the deflection is another motion.
void expect_growth(const model::Rotor &rotor, const std::vector<Growth> &expected) {
    const stability::HillSolver solver(tests::looked_at(rotor, results::Form::hill, 1), {});
    for (const auto &[speed, growth] : expected) {
        double off = 1e300;
        for (const stability::Motion &motion : solver.at(speed))
            off = std::min(off, std::abs(motion.value.real() - growth));
        // Both know the multipliers to some 1e-12.
        EXPECT_LT(off, 1e-10 * speed) << speed;
    }
}

void expect_bands(const model::Rotor &rotor, const model::SpeedRange &speeds,
                  const std::vector<double> &ends) {
    const model::Case scene = tests::scene_of(rotor, speeds.from, speeds.to, speeds.count);
    const auto bands = analyses::unstable_bands_of(scene, {}, false).bands;
    ASSERT_EQ(2 * bands.size(), ends.size()) << speeds.count;
    for (std::size_t i = 0; i < bands.size(); ++i) {
        EXPECT_NEAR(bands[i].from, ends[2 * i], 1e-8 * ends[2 * i]) << speeds.count;
        EXPECT_NEAR(bands[i].to, ends[2 * i + 1], 1e-8 * ends[2 * i + 1]) << speeds.count;
    }
}

// The rotor of cases/hill_rotor.
TEST(Monodromy, GrowthAndBandOfTheHillRotorAreThoseOfScipy) {
    const model::Rotor rotor = rigid_rotor(0.8, 0.5, 0.08, 4e5, 6e5, 20);
    expect_growth(rotor, {{250, -5.702068906917336},
                          {600, -4.232406989805228},
                          {920, 57.63231426084074},
                          {1300, -2.623423388701524}});
    for (const int count : {11, 501})
        expect_bands(rotor, {200, 1400, count}, {818.7077255996421, 1069.0133484724477});
}

// Bearings that differ ninefold, hardly damped, nearly the largest anisotropy: a band of 0.13 rad/s
// beside a wide one.
TEST(Monodromy, NarrowBandIsThatOfScipyWhateverTheGrid) {
    const model::Rotor rotor = rigid_rotor(0.8, 0.5, 0.24, 1e5, 9e5, 0.5);
    expect_growth(rotor, {{31, -0.16129417107152233},
                          {100, -0.15813657411847612},
                          {173.505, 0.0876187960240643},
                          {230, 10.159919796543408}});
    for (const int count : {11, 501})
        expect_bands(
            rotor, {160, 250, count},
            {173.43845195915952, 173.56929465644285, 224.49219453772196, 239.84981846142998});
}

/// Of an undamped rotor: conjugates have opposite actions, what grows has none, for the action
/// grows with it and stays the same. To the rounding of vectors, known to 1e-12 over 1e-4.
TEST(Monodromy, ActionIsConserved) {
    const model::Rotor rotor = rigid_rotor(0.8, 0.5, 0.08, 4e5, 6e5, 0);
    const assembly::Discretization discretization(rotor, 1);
    const periodic::System system(discretization, 0, {}, nullptr);
    ASSERT_TRUE(system.conserves(400));
    int grow = 0;
    int keep = 0;
    for (double speed = 205; speed < 1400; speed += 10) {
        const auto motions = periodic::floquet_motions(system, speed, 40);
        for (const periodic::FloquetMotion &motion : motions) {
            const double real = motion.value.real();
            if (std::abs(real) > 1e-4 * speed) {
                EXPECT_LT(std::abs(motion.action), 1e-8) << speed;
                ++grow;
            }
            for (const periodic::FloquetMotion &other : motions)
                if (std::abs(real) < 1e-9 * speed && motion.value.imag() > 0 &&
                    other.value == std::conj(motion.value)) {
                    EXPECT_NEAR(motion.action, -other.action, 1e-8);
                    ++keep;
                }
        }
    }
    EXPECT_GT(grow, 10);
    EXPECT_GT(keep, 100);
    const assembly::Discretization damped(rigid_rotor(0.8, 0.5, 0.08, 4e5, 6e5, 20), 1);
    EXPECT_FALSE(periodic::System(damped, 0, {}, nullptr).conserves(400));
}

} // namespace
