// The error that `critical` and `balance` print against the true one, and rotors out of the
// ordinary against closed forms.

#include "analyses/balance.h"
#include "analyses/critical.h"
#include "results/critical.h"
#include "results/whirl.h"
#include "support/random.h"
#include "support/scenes.h"
#include "support/written_case.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace {

using namespace whirl;
using results::CriticalResult;
using results::CriticalSpeed;
using tests::Random;

TEST(CriticalError, HoldsWhereOneOrderMoreChangesNothing) {
    // One element, symmetric: the next order adds functions of the other parity only.
    model::Case scene;
    scene.rotor.shaft = tests::uniform_shaft(1.0, 0.05, {"steel", 210e9, 210e9 / 2.6, 7850});
    scene.rotor.bearings = {tests::isotropic_bearing(0, 1e9), tests::isotropic_bearing(1, 1e9)};
    scene.campbell.modes = 4;
    const CriticalResult result = analyses::critical_speeds(scene);
    ASSERT_EQ(result.critical_speeds.size(), 4U);
    // The second backward one from spectral elements, digits printed.
    const double expected = 2495.216;
    int found = 0;
    for (const CriticalSpeed &critical : result.critical_speeds)
        if (critical.speed > 2000 && critical.whirl == results::Whirl::backward) {
            const double error = critical.speed / expected - 1;
            EXPECT_GT(error, 3e-3);
            EXPECT_GT(critical.error, error);
            EXPECT_LT(critical.error, 2 * error);
            ++found;
        }
    EXPECT_EQ(found, 1);
}

/// @param kind  0 isotropic, 1 orthotropic, 2 damped and coupled
model::Case random_scene(Random &random, int kind) {
    model::Case scene;
    const int segments = 1 + static_cast<int>(random(0, 2.999));
    scene.rotor.shaft = tests::uniform_shaft(random(0.2, 0.7), random(0.03, 0.12), tests::steel());
    for (int i = 1; i < segments; ++i)
        scene.rotor.shaft.segments.push_back(
            tests::uniform_shaft(random(0.2, 0.7), random(0.03, 0.12), tests::steel()).segments[0]);
    const double length = scene.rotor.shaft.length();
    const int discs = static_cast<int>(random(0, 2.999));
    for (int i = 0; i < discs; ++i)
        scene.rotor.discs.push_back(tests::disc_at(random(0.1, 0.9) * length, random(3, 30),
                                                   random(0.01, 0.2), random(0.01, 0.3)));
    for (const double z : {0.0, random(0.6, 1.0) * length}) {
        model::Bearing bearing =
            tests::isotropic_bearing(z, std::pow(10, random(5.5, 9)), kind == 2 ? 300 : 0);
        if (kind >= 1)
            bearing.rows[0].k(1, 1) *= random(0.3, 3);
        if (kind == 2)
            bearing.rows[0].k(0, 1) = 0.1 * bearing.rows[0].k(0, 0);
        scene.rotor.bearings.push_back(bearing);
    }
    scene.rotor.shaft.order = 1 + static_cast<int>(random(0, 4.999));
    for (model::Segment &segment : scene.rotor.shaft.segments)
        segment.elements = 1 + static_cast<int>(random(0, 2.999));
    scene.campbell.modes = 6;
    return scene;
}

TEST(CriticalError, IsAboveTheTrueErrorOfRandomRotors) {
    Random random(7);
    int points = 0;
    int above = 0;
    for (int rotor = 0; rotor < 90; ++rotor) {
        const model::Case scene = random_scene(random, rotor % 3);
        const CriticalResult result = analyses::critical_speeds(scene);
        model::Case fine = scene;
        fine.rotor.shaft.order = 12;
        for (model::Segment &segment : fine.rotor.shaft.segments)
            segment.elements = 2;
        fine.campbell.modes = 14;
        const CriticalResult reference = analyses::critical_speeds(fine);
        for (const results::Whirl whirl :
             {results::Whirl::forward, results::Whirl::backward, results::Whirl::mixed}) {
            std::vector<CriticalSpeed> given;
            std::vector<CriticalSpeed> best;
            const bool one_list = rotor % 3 != 0; // the sense of a mixed mode may change
            if (one_list && whirl != results::Whirl::forward)
                continue;
            for (const auto &c : result.critical_speeds)
                if (one_list || c.whirl == whirl)
                    given.push_back(c);
            for (const auto &c : reference.critical_speeds)
                if (one_list || c.whirl == whirl)
                    best.push_back(c);
            for (std::size_t i = 0; i < std::min(given.size(), best.size()); ++i) {
                ++points;
                const double error = std::abs(given[i].speed / best[i].speed - 1);
                above += error > given[i].error + best[i].error ? 1 : 0;
                EXPECT_LT(error, 2 * given[i].error + best[i].error)
                    << "rotor " << rotor << " at " << given[i].speed << " order "
                    << scene.rotor.shaft.order;
            }
        }
    }
    EXPECT_GT(points, 400);
    EXPECT_LE(100 * above, points);
}

/// A slot in a shaft on bearings that differ: crossings, and ends of ranges over which a motion
/// keeps the frequency of the spin.
TEST(CriticalError, IsAboveTheTrueErrorWhereRotorAndBearingsAreBothUnsymmetric) {
    model::Case scene = tests::written_case(R"(
[shaft]
segments = [{length = 5.0, outer = 0.5, asymmetry = 0.03, material = "s"}]
[[bearing]]
z = 0.3
kxx = 1e9
kyy = 2e9
cxx = 1e4
cyy = 2e4
[[bearing]]
z = 4.7
kxx = 1e9
kyy = 2e9
cxx = 1e4
cyy = 2e4
[speeds]
from = 200
to = 420
count = 15
[campbell]
modes = 4
)");
    scene.rotor.shaft.order_auto = false;
    scene.rotor.shaft.order = 7;
    const CriticalResult fine = analyses::critical_speeds(scene);
    ASSERT_EQ(fine.critical_speeds.size(), 4U);
    for (const int order : {3, 5}) { // of much and little error: from all of finer elements, or not
        scene.rotor.shaft.order = order;
        const CriticalResult coarse = analyses::critical_speeds(scene);
        ASSERT_EQ(coarse.critical_speeds.size(), 4U) << order;
        for (std::size_t i = 0; i < 4; ++i) {
            const CriticalSpeed &critical = coarse.critical_speeds[i];
            const double error = std::abs(critical.speed / fine.critical_speeds[i].speed - 1);
            EXPECT_GT(error, 1e-8) << order; // else nothing is tested
            EXPECT_GT(critical.error, error) << order;
            EXPECT_LT(critical.error, 2 * error) << order; // safety 1.25, and higher orders
        }
    }
}

TEST(BandErrors, AreAboveTheTrueOnes) {
    Random random(11);
    int ends = 0;
    int unknown = 0;
    for (int rotor = 0; rotor < 24; ++rotor) {
        model::Case scene = random_scene(random, rotor % 3);
        const double length = scene.rotor.shaft.length();
        scene.rotor.planes = {{"", random(0.1, 0.4) * length}, {"", random(0.6, 0.9) * length}};
        scene.speeds = model::SpeedRange{0, 1500, 16};
        const results::BalanceResult result = analyses::balance(scene);
        scene.rotor.shaft.order = 10;
        const results::BalanceResult reference = analyses::balance(scene);
        for (std::size_t which = 0; which < 3; ++which) {
            const auto &given = which < 2 ? result.planes[which].bands : result.joint.bands;
            const auto &best = which < 2 ? reference.planes[which].bands : reference.joint.bands;
            ASSERT_EQ(given.errors.size(), given.bands.size());
            if (given.bands.size() != best.bands.size())
                continue; // a band at the end of the range, or one that the mesh makes
            for (std::size_t i = 0; i < given.bands.size(); ++i)
                for (const bool upper : {false, true}) {
                    const double at = upper ? given.bands[i].to : given.bands[i].from;
                    const double to = upper ? best.bands[i].to : best.bands[i].from;
                    const auto error = upper ? given.errors[i].second : given.errors[i].first;
                    const auto rest = upper ? best.errors[i].second : best.errors[i].first;
                    if (at == 1500 || to == 1500) {
                        EXPECT_TRUE(at != 1500 || *error == 0);
                        continue;
                    }
                    if (!error || !rest) { // said to be on one of the two models only
                        ++unknown;
                        continue;
                    }
                    EXPECT_LE(std::abs(at - to), *error + *rest) << rotor << " " << at;
                    ++ends;
                }
        }
    }
    EXPECT_GT(ends, 100);
    EXPECT_LT(20 * unknown, ends);
}

/// The bearings as they are at one speed.
model::Case frozen(model::Case scene, double speed) {
    for (model::Bearing &bearing : scene.rotor.bearings) {
        bearing.rows = {bearing.at(speed)};
        bearing.speeds.clear();
    }
    return scene;
}

// Rows so near that many are followed at once. A motion is below the speed from its critical speed
// on, so of the rotor with its bearings as they are at any speed as many synchronous motions are
// below that speed as the list has critical speeds below it.
TEST(CriticalSpeeds, OfFineTablesAreThoseThatCountsAtConstantBearingsShow) {
    Random random(11);
    for (int rotor = 0; rotor < 3; ++rotor) {
        model::Case scene = random_scene(random, 2);
        const double phase = random(0, 6);
        for (model::Bearing &bearing : scene.rotor.bearings) {
            const model::BearingCoefficients mean = bearing.rows.front();
            bearing.rows.clear();
            for (double speed = 20; speed < 4000; speed *= 1.01) {
                model::BearingCoefficients row = mean;
                row.k *= 1 + 0.4 * std::sin(1.5 * std::log(speed) + phase);
                row.c *= 1 + 0.4 * std::cos(1.5 * std::log(speed) + phase);
                bearing.speeds.push_back(speed);
                bearing.rows.push_back(row);
            }
        }
        scene.speeds = model::SpeedRange{0, 3500, 2};
        const std::vector<CriticalSpeed> found = analyses::critical_speeds(scene).critical_speeds;
        for (double speed = 25; speed < 3500; speed *= 1.15) {
            const auto below = [speed](const std::vector<CriticalSpeed> &list) {
                return std::count_if(list.begin(), list.end(),
                                     [speed](const CriticalSpeed &c) { return c.speed < speed; });
            };
            const auto expected =
                below(analyses::unjudged_critical_speeds(frozen(scene, speed)).critical_speeds);
            EXPECT_EQ(below(found), expected) << "rotor " << rotor << " at " << speed;
        }
        for (const CriticalSpeed &critical : found) { // each stands where its bearings are
            const auto there =
                analyses::unjudged_critical_speeds(frozen(scene, critical.speed)).critical_speeds;
            double nearest = 1;
            for (const CriticalSpeed &c : there)
                nearest = std::min(nearest, std::abs(c.speed / critical.speed - 1));
            if (critical.speed < 3500)
                EXPECT_LT(nearest, 1e-9) << "rotor " << rotor << ", " << critical.speed;
        }
    }
}

// A disc in the middle of a symmetric rotor does not tilt in the first mode: forward and backward
// critical speeds are one, and no mixture of the two shapes is named twice alike.
TEST(CriticalSpeeds, OfOneEigenvalueAreOneForwardAndOneBackward) {
    model::Case scene;
    scene.rotor.shaft = tests::uniform_shaft(1.0, 0.03, tests::steel());
    scene.rotor.discs = {tests::disc_at(0.5, 20, 0.1, 0.2)};
    scene.campbell.modes = 2;
    for (const double damping : {0.0, 1e-6, 50.0}) {
        scene.rotor.bearings = {tests::isotropic_bearing(0, 1e6, damping),
                                tests::isotropic_bearing(1, 1e6, damping)};
        for (const auto form : {model::FormChoice::automatic, model::FormChoice::general}) {
            scene.formulation = form;
            const auto list = analyses::critical_speeds(scene).critical_speeds;
            ASSERT_GE(list.size(), 2U);
            // The shaft's own sections tilt: 1e-4.
            EXPECT_NEAR(list[1].speed / list[0].speed, 1, 1e-3);
            const auto forward = [](const CriticalSpeed &c) {
                return c.whirl == results::Whirl::forward;
            };
            const auto backward = [](const CriticalSpeed &c) {
                return c.whirl == results::Whirl::backward;
            };
            EXPECT_EQ(std::count_if(list.begin(), list.begin() + 2, forward), 1) << damping;
            EXPECT_EQ(std::count_if(list.begin(), list.begin() + 2, backward), 1) << damping;
        }
    }
    // Without rotary inertia of the shaft they are one to rounding.
    scene.rotor.shaft.rotary_inertia = false;
    scene.formulation = model::FormChoice::general;
    const auto list = analyses::critical_speeds(scene).critical_speeds;
    ASSERT_GE(list.size(), 2U);
    EXPECT_NEAR(list[1].speed / list[0].speed, 1, 1e-8);
    EXPECT_NE(list[0].whirl, list[1].whirl);
    EXPECT_NE(list[0].whirl, results::Whirl::mixed);
    EXPECT_NE(list[1].whirl, results::Whirl::mixed);
}

} // namespace
