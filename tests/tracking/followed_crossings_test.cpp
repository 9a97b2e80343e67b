// Plain crossings found on the motion alone: against the search that solves all modes at each speed
// it looks at, and against the eigenvalue of the whole rotor there.

#include "tracking/followed_crossings.h"

#include "modes/spectrum.h"
#include "support/random.h"
#include "support/random_discs.h"
#include "support/scenes.h"
#include "tracking/crossings.h"
#include "tracking/followed_lines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace whirl::tracking {

namespace {

/// Damped, with supports that differ in x and y, and a cross coupling in some.
model::Rotor sample_rotor(tests::Random &random) {
    model::Rotor rotor;
    rotor.shaft = tests::uniform_shaft(random(0.8, 1.5), random(0.04, 0.08), tests::steel());
    rotor.shaft.segments[0].elements = 3;
    tests::add_two_discs(random, rotor);
    const double length = rotor.shaft.length();
    for (const double z : {0.0, length}) {
        model::Bearing bearing =
            tests::isotropic_bearing(z, std::pow(10, random(6, 8)), std::pow(10, random(1, 4)));
        model::BearingCoefficients &row = bearing.rows[0];
        row.k(1, 1) *= random(1.1, 2);
        if (random.coin()) {
            row.k(0, 1) = random(-0.03, 0.03) * row.k(0, 0);
            row.k(1, 0) = -row.k(0, 1);
        }
        rotor.bearings.push_back(bearing);
    }
    return rotor;
}

/// Of the same lines by one route or the other.
struct Diagram {
    modes::SpectrumSolver solver;
    FollowedLines lines;
    std::vector<results::Crossing> found;

    Diagram(const model::Rotor &rotor, const std::vector<double> &speeds, bool refined)
        : solver(rotor, results::Form::general, 4), lines([&] {
              if (!refined)
                  solver.take_all_unknowns();
              return followed_lines(solver, speeds, 6, refined);
          }()),
          found(crossings(solver, lines.tracking, lines.spectra, {0.5, 1, 2}).found) {}
};

TEST(FollowedCrossings, AreThoseOfTheSearchThatSolvesAllModes) {
    tests::Random random(31);
    std::size_t plain = 0;
    std::size_t all = 0;
    for (int draw = 0; draw < 6; ++draw) {
        SCOPED_TRACE(draw);
        const model::Rotor rotor = sample_rotor(random);
        std::vector<double> speeds;
        const double from = draw % 3 == 2 ? -1500 : 0; // also backwards
        for (int k = 0; k <= 30; ++k)
            speeds.push_back(from + 50 * k);
        const Diagram followed(rotor, speeds, true);
        const Diagram alone(rotor, speeds, false);
        ASSERT_TRUE(followed.solver.refines());
        ASSERT_FALSE(alone.solver.refines());
        ASSERT_EQ(followed.found.size(), alone.found.size());
        for (std::size_t i = 0; i < alone.found.size(); ++i) {
            // Both are known to some 1e-11 (crossing_step.h) over the angle between the lines.
            EXPECT_NEAR(followed.found[i].speed, alone.found[i].speed,
                        1e-9 * std::abs(alone.found[i].speed));
            EXPECT_EQ(followed.found[i].multiple, alone.found[i].multiple);
        }
        all += alone.found.size();
        const SweepNodes nodes(followed.solver, followed.lines.tracking, followed.lines.spectra);
        for (const double multiple : {0.5, 1.0, 2.0})
            for (const FollowedCrossing &crossing : followed_crossings(nodes, multiple)) {
                ++plain;
                const modes::Spectrum there = alone.solver.at(crossing.speed, 8);
                double nearest = 1;
                for (const modes::WhirlMode &mode : there.modes)
                    nearest = std::min(
                        nearest,
                        std::abs(mode.eigenvalue -
                                 std::complex(crossing.real, multiple * std::abs(crossing.speed))) /
                            std::abs(mode.eigenvalue));
                EXPECT_LT(nearest, 1e-10) << multiple << " at " << crossing.speed;
            }
    }
    EXPECT_GT(all, 30U);
    EXPECT_GT(2 * plain, all) << "of most crossings the motion alone is enough";
}

} // namespace

} // namespace whirl::tracking
