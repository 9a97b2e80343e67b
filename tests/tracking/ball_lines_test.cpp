// Motions of balls that stand still in the rotor, as lines of the Campbell diagram.

#include "analyses/campbell.h"
#include "modes/spectrum.h"
#include "results/campbell.h"
#include "support/written_case.h"
#include "tracking/tracking.h"

#include <gtest/gtest.h>

#include <cmath>
#include <variant>
#include <vector>

namespace ball_lines_test {

using namespace whirl;

/// Two balancers without an imbalance of their own: their balls stand on one diameter (two) or
/// evenly. From rest on some motions stand still in the rotor, all but equal in both balancers.
constexpr const char *decanter = R"(
[shaft]
order = 4
segments = [
  {length = 0.3, outer = 0.12, material = "s"},
  {length = 1.6, outer = 0.4, inner = 0.36, material = "s"},
  {length = 0.3, outer = 0.12, material = "s"},
]
[[disc]]
z = 0.3
mass = 40
Id = 1.0
Ip = 1.9
[[disc]]
z = 1.9
mass = 40
Id = 1.0
Ip = 1.9
[[bearing]]
z = 0.05
k = 1.5e6
c = 1500
[[bearing]]
z = 2.15
k = 2e6
c = 2000
[[balancer]]
z = 0.3
kind = "ball"
n = 2
mass = 0.12
radius = 0.2
damping = 0.9
[[balancer]]
z = 1.9
kind = "ball"
n = 2
mass = 0.12
radius = 0.2
damping = 0.9
[speeds]
from = 0
to = 420
count = 31
)";

/// Each line is one motion from end to end; at rest nothing of the balls whirls.
TEST(BallLines, AreFollowedFromEndToEnd) {
    for (const bool equal : {false, true})
        for (const int balls : {2, 3}) {
            model::Case scene = tests::written_case(decanter);
            for (model::Balancer &balancer : scene.rotor.balancers)
                std::get<model::Balls>(balancer.parts).rows[0].n = balls;
            if (equal) // and a rotor that is its own mirror image
                scene.rotor.bearings[1].rows = scene.rotor.bearings[0].rows;
            scene.campbell.modes = 12;
            const results::CampbellResult result = analyses::campbell(scene);
            for (const auto &mode : result.modes)
                for (std::size_t k = 1; k < result.speeds.size(); ++k)
                    EXPECT_TRUE(mode.frequency[k].has_value()) << balls << equal << k;
            for (const auto &note : result.model.notes)
                EXPECT_EQ(note.find("could not be followed"), std::string::npos) << note;
        }
}

/// The same motions whatever number of them is asked for.
TEST(BallLines, AreTheSameWhateverNumberIsAskedFor) {
    const model::Case scene = tests::written_case(decanter);
    const modes::SpectrumSolver solver(scene.rotor, results::Form::rotating, 4);
    for (const double speed : {0.15, 20.0, 105.0, 209.44}) {
        const modes::Spectrum all = solver.at(speed, 16);
        for (const int wanted : {8, 9, 11}) {
            const modes::Spectrum some = solver.at(speed, wanted);
            for (std::size_t i = 0; i < 8; ++i)
                EXPECT_LT(std::abs(some.modes[i].eigenvalue - all.modes[i].eigenvalue),
                          1e-9 * std::abs(all.modes[i].eigenvalue))
                    << speed << " " << wanted << " " << i;
        }
    }
}

/// On unequal bearings motions are Hill series, and which copy of one is largest changes: near
/// 754 rad/s the second bending forward and backward are 2 x 754 apart and exchange their parts, at
/// 800 a motion of the balls ceases to stand still. Each line goes on, with its sense of whirl.
TEST(BallLines, OnUnequalBearingsAreFollowedThroughCopies) {
    model::Case scene = tests::written_case(decanter);
    scene.rotor.shaft.order = 1;
    scene.rotor.bearings[0].rows[0].k << 4e7, 0, 0, 6e7;
    scene.rotor.bearings[0].rows[0].c = 5000 * Eigen::Matrix2d::Identity();
    scene.rotor.bearings[1].rows[0].k = 6e7 * Eigen::Matrix2d::Identity();
    scene.rotor.bearings[1].rows[0].c = 6000 * Eigen::Matrix2d::Identity();
    scene.rotor.balancers.pop_back();
    const modes::SpectrumSolver solver(scene.rotor, results::Form::hill, 1);
    constexpr int modes = 8;
    const std::vector<modes::Spectrum> spectra{solver.at(700, modes), solver.at(900, modes)};
    const tracking::Tracking tracking = tracking::track(solver, spectra, modes);
    EXPECT_TRUE(tracking.gaps.empty());
    EXPECT_EQ(tracking.lines.size(), static_cast<std::size_t>(modes));
    for (const tracking::Line &line : tracking.lines) {
        ASSERT_NE(line.place[0], tracking::Line::absent);
        ASSERT_NE(line.place[1], tracking::Line::absent);
        EXPECT_EQ(spectra[0].modes[static_cast<std::size_t>(line.place[0])].whirl,
                  spectra[1].modes[static_cast<std::size_t>(line.place[1])].whirl);
    }
}

} // namespace ball_lines_test
