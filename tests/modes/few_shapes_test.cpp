// Modes of a rotor on few shapes against those of all its unknowns.

#include "modes/spectrum.h"
#include "results/formulation.h"
#include "support/random.h"
#include "support/scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

using namespace whirl;

/// Three discs on bearings that differ in x and y and damp.
model::Rotor random_rotor(tests::Random &random) {
    model::Rotor rotor;
    rotor.shaft = tests::uniform_shaft(1.4, random(0.05, 0.12), tests::steel());
    rotor.shaft.segments[0].elements = 20;
    for (const double z : {0.3, 0.7, 1.1}) {
        const double mass = random(5, 50);
        const double Id = mass * random(0.002, 0.02);
        rotor.discs.push_back(tests::disc_at(z, mass, Id, random(1, 1.9) * Id));
    }
    for (const double z : {0.0, 1.4}) {
        model::Bearing bearing =
            tests::isotropic_bearing(z, std::pow(10, random(6, 8)), std::pow(10, random(2, 3.5)));
        bearing.rows[0].k(1, 1) *= random(0.5, 2);
        bearing.rows[0].c(1, 1) *= random(0.5, 2);
        rotor.bearings.push_back(bearing);
    }
    return rotor;
}

double off(std::complex<double> value, const modes::Spectrum &among) {
    double least = INFINITY;
    for (const modes::WhirlMode &mode : among.modes)
        least = std::min(least, std::abs(mode.eigenvalue - value));
    return least / std::abs(value);
}

TEST(FewShapes, AreOffByWhatTheySay) {
    tests::Random random(11);
    int telling = 0;
    for (int scene = 0; scene < 25; ++scene) {
        const model::Rotor rotor = random_rotor(random);
        const modes::SpectrumSolver whole(rotor, results::Form::general, 3);
        modes::SpectrumSolver few(rotor, results::Form::general, 3);
        ASSERT_TRUE(few.take_few_shapes(12));
        EXPECT_LT(few.unknowns(), whole.unknowns() / 3);
        for (const double speed : {0.0, 700.0, 2500.0}) {
            const modes::Spectrum near = few.at(speed, 12);
            const modes::Spectrum all = whole.at(speed, 16);
            ASSERT_EQ(near.modes.size(), 12U);
            for (const modes::WhirlMode &mode : near.modes) {
                const double said = few.left_out(speed, mode);
                const double error = off(mode.eigenvalue, all);
                // An estimate of the second order: a factor, and the rounding of the whole rotor.
                EXPECT_LE(error, 5 * said + 1e-8) << scene << " at " << speed;
                telling += said < 1e-4 ? 1 : 0;
            }
        }
    }
    EXPECT_GT(telling, 800); // of 900: else the shapes were no use
}

TEST(FewShapes, AreNotTakenWhereTheRotorIsFreeOrSmall) {
    tests::Random random(3);
    model::Rotor rotor = random_rotor(random);
    rotor.shaft.segments[0].elements = 1;
    EXPECT_FALSE(modes::SpectrumSolver(rotor, results::Form::general, 1).take_few_shapes(12));
    rotor.shaft.segments[0].elements = 20;
    rotor.bearings.pop_back(); // the shaft swings about the other one
    EXPECT_FALSE(modes::SpectrumSolver(rotor, results::Form::general, 3).take_few_shapes(12));
}

// Internal damping of 1 ms: overdamped motions crowd at -1000 1/s, where no few of them are found
// alone.
TEST(Spectrum, NeedsAllEigenvaluesWhereMotionsCrowd) {
    tests::Random random(3);
    model::Rotor rotor = random_rotor(random);
    EXPECT_FALSE(
        modes::SpectrumSolver(rotor, results::Form::general, 3).needs_all_eigenvalues(100, 8));
    rotor.shaft.internal_damping = 1e-3;
    EXPECT_TRUE(
        modes::SpectrumSolver(rotor, results::Form::general, 3).needs_all_eigenvalues(100, 8));
}

} // namespace
