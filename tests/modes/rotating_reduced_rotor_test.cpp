// Modes in rotating axes that begin on few shapes against those that the whole rotor's eigensolver
// finds by itself.

#include "model/balancer.h"
#include "modes/spectrum.h"
#include "results/formulation.h"
#include "support/random.h"
#include "support/scenes.h"
#include "tracking/bands/locked_whirl.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace rotating_reduced_rotor {

using namespace whirl;

/// Two discs, one of them unlike in x and y, on damped bearings.
model::Rotor random_rotor(tests::Random &random) {
    model::Rotor rotor;
    rotor.shaft = tests::uniform_shaft(1.2, random(0.04, 0.1), tests::steel());
    rotor.shaft.segments[0].elements = 12;
    for (const double z : {0.3, 0.8}) {
        const double mass = random(10, 50);
        const double Id = mass * random(0.005, 0.02);
        rotor.discs.push_back(tests::disc_at(z, mass, Id, random(1.2, 1.9) * Id));
    }
    const double dI = random(0.05, 0.3) * rotor.discs[0].Id;
    rotor.anisotropies.push_back({});
    rotor.anisotropies.back().z = 0.3;
    rotor.anisotropies.back().dI = dI;
    for (const double z : {0.0, 1.2})
        rotor.bearings.push_back(
            tests::isotropic_bearing(z, std::pow(10, random(6, 7.5)), std::pow(10, random(1, 3))));
    return rotor;
}

TEST(RotatingReducedRotor, ModesAreThoseOfTheWholeRotor) {
    tests::Random random(5);
    int with_left = 0;
    for (int scene = 0; scene < 8; ++scene) {
        const model::Rotor rotor = random_rotor(random);
        const modes::SpectrumSolver whole(rotor, results::Form::rotating, 3);
        const modes::SpectrumSolver few(rotor, results::Form::rotating, 3);
        std::vector<double> speeds;
        for (int k = 0; k <= 10; ++k)
            speeds.push_back(10 + 60.0 * k);
        few.follow(speeds, 10);
        for (const double speed : {23.0, 171.0, 398.0, 600.0}) {
            const modes::Spectrum a = few.at(speed, 10);
            const modes::Spectrum b = whole.at(speed, 10);
            ASSERT_EQ(a.modes.size(), b.modes.size());
            for (std::size_t i = 0; i < a.modes.size(); ++i) {
                const auto &[x, y] = std::pair(a.modes[i], b.modes[i]);
                const double allowed = 1e-9 + 2 * (x.residual + x.rounding + y.residual);
                EXPECT_LE(std::abs(x.eigenvalue - y.eigenvalue), allowed * std::abs(y.eigenvalue))
                    << scene << " at " << speed;
                with_left += x.left.size() > 0 ? 1 : 0;
            }
            if (with_left == 0)
                continue;
            // Left vectors of the one are those of the other up to their length.
            const modes::ModeBasis one = few.basis(a);
            const modes::ModeBasis other = whole.basis(b);
            for (Eigen::Index i = 0; i < one.complex_left.cols(); ++i)
                EXPECT_NEAR(std::abs(modes::overlap(one, other, i, i)), 1, 1e-6)
                    << scene << " at " << speed;
        }
    }
    EXPECT_GT(with_left, 200); // of 320: else the shapes were no use
}

TEST(RotatingReducedRotor, EndsOfLockedBandsAreThoseOfTheWholeRotor) {
    tests::Random random(6);
    int found = 0;
    for (int scene = 0; scene < 4; ++scene) {
        const model::Rotor rotor = random_rotor(random);
        const modes::SpectrumSolver whole(rotor, results::Form::rotating, 3);
        const modes::SpectrumSolver few(rotor, results::Form::rotating, 3);
        std::vector<double> speeds;
        for (int k = 0; k <= 10; ++k)
            speeds.push_back(10 + 90.0 * k);
        few.follow(speeds, 8);
        ASSERT_NE(few.reduced_for(10, 910, 8), nullptr);
        const auto a = tracking::lock_ends_over(few, 10, 910, 8);
        const auto b = tracking::lock_ends_over(whole, 10, 910, 8);
        ASSERT_EQ(a.size(), b.size()) << scene;
        for (std::size_t i = 0; i < a.size(); ++i)
            EXPECT_NEAR(a[i].speed, b[i].speed, 1e-9 * b[i].speed) << scene;
        found += static_cast<int>(a.size());
    }
    EXPECT_GT(found, 4);
}

} // namespace rotating_reduced_rotor
