// Damping at crossings, and motions that stay on a multiple of the spin speed, against formulas of
// rigid rotors and over grids.

#include "analyses/campbell.h"
#include "assembly/discretization.h"
#include "input/case_file.h"
#include "modes/spectrum.h"
#include "results/campbell.h"
#include "support/periodic_system.h"
#include "support/rotating_scenes.h"
#include "support/scenes.h"
#include "support/written_case.h"
#include "tracking/bands/locked_whirl.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

namespace locked_test {

using namespace whirl;

constexpr double mass = 40;
constexpr double Id = 2;
constexpr double Ip = 1.2;
constexpr double l = 0.5; ///< from the centre of mass to each bearing

/// A rigid rotor on two equal bearings.
model::Case rigid_scene(double k, double c, model::SpeedRange range) {
    model::Case scene;
    scene.rotor.shaft = tests::uniform_shaft(2 * l, 0.02, tests::weightless_steel());
    scene.rotor.shaft.rigid = true;
    scene.rotor.discs = {tests::disc_at(l, mass, Id, Ip)};
    if (k > 0)
        scene.rotor.bearings = {tests::isotropic_bearing(0, k), tests::isotropic_bearing(2 * l, k)};
    for (model::Bearing &bearing : scene.rotor.bearings)
        bearing.rows[0].c = c * Eigen::Matrix2d::Identity();
    scene.campbell.modes = 4;
    scene.speeds = range;
    return scene;
}

/// The same tilting rotor with unequal diametral inertias: it stands still in the rotor between
/// sqrt(K/(Id - Ip + dI)) and sqrt(K/(Id - Ip - dI)).
model::Case uneven_scene(double dI, model::SpeedRange range) {
    model::Case scene = rigid_scene(1e5, 0, range);
    scene.rotor.anisotropies = {{"", l, dI, 0.4}};
    return scene;
}

TEST(CrossingDamping, OfTheBounceIsItsFormulaOnEveryGrid) {
    // m w'' + 2 c w' + 2 k w = 0: Re = -c/m, modulus sqrt(2k/m), whatever the speed.
    const double k = 1e5;
    const double natural = std::sqrt(2 * k / mass);
    for (const double ratio : {1e-3, 0.1, 0.4, 0.7}) {
        const double c = ratio * std::sqrt(2 * k * mass);
        const double damped = natural * std::sqrt(1 - ratio * ratio);
        for (const int count : {2, 7, 40}) {
            const auto result = analyses::campbell(rigid_scene(k, c, {1, 200, count}));
            int met = 0;
            for (const results::Crossing &crossing : result.crossings) {
                if (std::abs(crossing.speed / damped - 1) > 1e-9)
                    continue; // of the tilt
                ++met;
                EXPECT_NEAR(*crossing.damping.ratio / ratio, 1, 1e-9);
                EXPECT_NEAR(*crossing.damping.log_dec * damped,
                            2 * std::numbers::pi * ratio * natural, 1e-9 * natural);
                EXPECT_NEAR(*crossing.damping.amplification * 2 * ratio, 1, 1e-9);
                EXPECT_EQ(crossing.damping.heavy(), ratio > 0.2);
            }
            EXPECT_EQ(met, 2) << "forward and backward, " << ratio << " " << count;
        }
    }
}

TEST(CrossingDamping, IsNoneWithoutDamping) {
    const auto result = analyses::campbell(rigid_scene(1e5, 0, {1, 200, 5}));
    ASSERT_FALSE(result.crossings.empty());
    for (const results::Crossing &crossing : result.crossings) {
        EXPECT_EQ(crossing.damping.ratio, 0);
        EXPECT_EQ(crossing.damping.log_dec, 0);
        EXPECT_FALSE(crossing.damping.amplification);
        EXPECT_FALSE(crossing.damping.heavy());
    }
}

TEST(Locked, AFreeTiltLiesOnTheRatioOfItsInertias) {
    for (const int count : {3, 9, 30})
        for (const double from : {-300.0, 0.0, 20.0}) {
            model::Case scene = rigid_scene(0, 0, {from, 500, count});
            scene.campbell.multiples = {1, Ip / Id};
            const auto result = analyses::campbell(scene);
            EXPECT_TRUE(result.crossings.empty()) << count << " " << from;
            ASSERT_FALSE(result.locked.empty()) << count << " " << from;
            for (const results::Locked &locked : result.locked) {
                EXPECT_EQ(locked.multiple, Ip / Id);
                EXPECT_EQ(result.modes[static_cast<std::size_t>(locked.mode)].label.back(), 'F');
            }
            EXPECT_EQ(result.locked.back().to, 500);
            if (from >= 0) {
                EXPECT_EQ(result.locked.front().from, from);
            }
        }
}

TEST(Locked, BetweenTheTwoCriticalSpeedsOfAnAsymmetricRotor) {
    const double K = 2 * 1e5 * l * l;
    for (const double dI : {0.2, 0.01, 1e-3, 1e-5}) { // the narrow ones: 1/1000 of the range, less
        const double low = std::sqrt(K / (Id - Ip + dI));
        const double high = std::sqrt(K / (Id - Ip - dI));
        for (const int count : {2, 3, 21}) {
            const auto result = analyses::campbell(uneven_scene(dI, {150, 400, count}));
            ASSERT_EQ(result.locked.size(), 1U) << dI << " " << count;
            EXPECT_EQ(result.locked[0].multiple, 1);
            EXPECT_NEAR(result.locked[0].from / low, 1, 1e-9);
            EXPECT_NEAR(result.locked[0].to / high, 1, 1e-9);
        }
    }
}

/// The tilting rotor of cases/hill_rotor.
model::Case hill_scene(double c) {
    model::Case scene;
    scene.rotor.shaft = tests::weightless_rigid_shaft(1);
    scene.rotor.discs = {tests::disc(0.5, 20, 0.8, 0.5)};
    scene.rotor.anisotropies = {{"", 0.5, 0.08, 0}};
    scene.rotor.bearings = {tests::bearing(0, 4e5, 6e5, 0, c), tests::bearing(1, 4e5, 6e5, 0, c)};
    return scene;
}

TEST(Locked, OnUnequalBearingsIsWhereAnUndampedRotorGrows) {
    // Without its damping: what stands still in it grows, and what does not keeps its size, by the
    // multipliers of its periodic equations.
    model::Case scene = hill_scene(0);
    const assembly::Discretization d(scene.rotor, 1);
    for (const int count : {8, 31}) {
        scene.speeds = {600, 1300, count};
        const results::CampbellResult result = analyses::campbell(scene);
        ASSERT_EQ(result.locked.size(), 1U) << count;
        const auto [from, to] = std::pair(result.locked[0].from, result.locked[0].to);
        // Next to an end growth rises with the root of the distance: far above rounding here.
        const double beside = 1e-4 * (to - from);
        for (const double inside : {from + beside, (from + to) / 2, to - beside})
            EXPECT_GT(tests::PeriodicSystem(d, inside, {}).growth(400), 1e-2) << inside;
        for (const double outside : {from - beside, to + beside})
            EXPECT_LT(tests::PeriodicSystem(d, outside, {}).growth(400), 1e-6) << outside;
    }
}

/// Multipliers of the periodic equations without imaginary part: of motions at a whole multiple of
/// the spin speed.
int real_multipliers(const assembly::Discretization &d, double speed) {
    int out = 0;
    for (const std::complex<double> &multiplier :
         tests::PeriodicSystem(d, speed, {}).multipliers(400))
        out += std::abs(multiplier.imag()) < 1e-7 * std::abs(multiplier);
    return out;
}

TEST(Locked, InANarrowBandOfADampedRotorOnUnequalBearingsIsTheSameOnEveryGrid) {
    // The backward tilt meets its own copy about the spin speed it crosses; in
    // the band two multipliers are real, outside none.
    model::Case scene = hill_scene(20);
    const assembly::Discretization d(scene.rotor, 1);
    for (const auto &[low, high, count] :
         {std::tuple(420.0, 440.0, 2), std::tuple(420.0, 440.0, 3), std::tuple(415.0, 445.0, 41)}) {
        scene.speeds = {low, high, count};
        const results::CampbellResult result = analyses::campbell(scene);
        ASSERT_EQ(result.locked.size(), 1U) << count;
        const auto [from, to] = std::pair(result.locked[0].from, result.locked[0].to);
        const double beside = 1e-4 * (to - from);
        for (const double inside : {from + beside, (from + to) / 2, to - beside})
            EXPECT_EQ(real_multipliers(d, inside), 2) << inside;
        for (const double outside : {from - beside, to + beside})
            EXPECT_EQ(real_multipliers(d, outside), 0) << outside;
        ASSERT_EQ(result.crossings.size(), 2U) << count;
        EXPECT_EQ(result.crossings[0].speed, from);
        EXPECT_EQ(result.crossings[1].speed, to);
    }
}

TEST(Locked, EndsWithTheRange) {
    const double K = 2 * 1e5 * l * l;
    const double low = std::sqrt(K / (Id - Ip + 0.2));
    const double high = std::sqrt(K / (Id - Ip - 0.2));
    const double middle = (low + high) / 2;
    for (const int count : {2, 8}) {
        const auto below = analyses::campbell(uneven_scene(0.2, {150, middle, count})).locked;
        ASSERT_EQ(below.size(), 1U);
        EXPECT_NEAR(below[0].from / low, 1, 1e-9);
        EXPECT_EQ(below[0].to, middle);
        const auto above = analyses::campbell(uneven_scene(0.2, {middle, 400, count})).locked;
        ASSERT_EQ(above.size(), 1U);
        EXPECT_EQ(above[0].from, middle);
        EXPECT_NEAR(above[0].to / high, 1, 1e-9);
        const auto turned = analyses::campbell(uneven_scene(0.2, {-400, -150, count})).locked;
        ASSERT_EQ(turned.size(), 1U);
        EXPECT_NEAR(turned[0].from / -high, 1, 1e-9);
        EXPECT_NEAR(turned[0].to / -low, 1, 1e-9);
    }
}

/// Without damping: motions that grow and that die out part at one speed, -71.79 and 71.79 rad/s.
constexpr const char *undamped_balls = R"(
[shaft]
order = 4
segments = [{length = 0.5, outer = 0.05, material = "s"}]
[[disc]]
z = 0.269
mass = 6.384
Id = 0.4096
Ip = 0.24342
[[bearing]]
z = 0
k = 1.7091e6
[[bearing]]
z = 0.5
k = 5.7058e6
[[anisotropy]]
z = 0.269
dI = 0.10912
[[balancer]]
z = 0.371
kind = "ball"
n = 3
mass = 0.05855
radius = 0.1817
imbalance = 0.02182
[speeds]
from = -300
to = 300
count = 5
)";

/// Bands whose ends are the speeds themselves at which something stands still.
constexpr const char *two_stiffnesses = R"(
[shaft]
order = 3
segments = [{length = 1.0, outer = 0.05, asymmetry = 0.3, material = "s"}]
[[disc]]
z = 0.747
mass = 18.3
Id = 0.49147
Ip = 0.24978
[[disc]]
z = 0.474
mass = 12.22
Id = 0.17151
Ip = 0.10547
[[bearing]]
z = 0
k = 2.5849e6
[[bearing]]
z = 1
k = 9.1073e6
[[anisotropy]]
z = 0.747
dI = 0.057623
[speeds]
from = -3000
to = 0
count = 5
)";

/// As many intervals cover a speed as motions stand still there, counted at that speed alone.
void expect_covered(const model::Case &scene, int order, const std::string &name) {
    const std::vector<results::Locked> locked = analyses::campbell(scene).locked;
    const modes::SpectrumSolver solver(scene.rotor, results::Form::rotating, order);
    for (int k = 0; k < 30; ++k) { // off every grid that the search may use
        const double from = scene.speeds->from;
        const double speed = from + (scene.speeds->to - from) * (k + 0.37) / 30.2;
        if (std::abs(speed) < 8)
            continue; // rounding decides whether balls stand
        const modes::Spectrum all = solver.at(speed, 40);
        const auto standing = std::count_if(
            all.modes.begin(), all.modes.end(),
            [speed](const modes::WhirlMode &mode) { return tracking::locked(mode, speed); });
        const auto covering =
            std::count_if(locked.begin(), locked.end(), [speed](const results::Locked &interval) {
                return interval.multiple == 1 && interval.from <= speed && speed <= interval.to;
            });
        EXPECT_EQ(covering, standing) << name << " " << speed << " count " << scene.speeds->count;
    }
}

TEST(Locked, CoversEverySpeedAsOftenAsMotionsStandStillThere) {
    for (const char *name : {"disc_type_short", "extractor_two_plane"}) {
        model::Case scene = input::load_case(std::string(WHIRL_ROOT "/cases/") + name);
        scene.speeds->count = 24;
        expect_covered(scene, 5, name);
    }
    for (const int count : {5, 50}) {
        model::Case balls = tests::written_case(undamped_balls);
        balls.speeds->count = count;
        expect_covered(balls, 4, "undamped balls");
        model::Case uneven = tests::written_case(two_stiffnesses);
        uneven.speeds->count = count;
        expect_covered(uneven, 3, "two stiffnesses");
    }
}

TEST(Locked, OfBallsIsTheSameOnEveryGrid) {
    for (const char *name : {"extractor_two_plane", "centrifuge_two_balls"}) {
        std::vector<results::Locked> coarse;
        for (const int count : {3, 8, 36}) {
            model::Case scene = input::load_case(std::string(WHIRL_ROOT "/cases/") + name);
            scene.speeds = model::SpeedRange{50, 400, count};
            scene.campbell.modes = 4;
            const results::CampbellResult result = analyses::campbell(scene);
            for (const results::Crossing &crossing : result.crossings)
                for (const double speed : result.speeds)
                    EXPECT_GT(std::abs(crossing.speed / speed - 1), 1e-9) << "of the grid";
            if (coarse.empty())
                coarse = result.locked;
            EXPECT_FALSE(coarse.empty()) << name;
            ASSERT_EQ(result.locked.size(), coarse.size()) << name;
            for (std::size_t i = 0; i < coarse.size(); ++i) {
                EXPECT_NEAR(result.locked[i].from / coarse[i].from, 1, 1e-8) << name << i;
                EXPECT_NEAR(result.locked[i].to / coarse[i].to, 1, 1e-8) << name << i;
            }
        }
    }
}

} // namespace locked_test
